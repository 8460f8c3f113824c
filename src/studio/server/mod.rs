//! The studio's server, on the loopback address alone.
//!
//! ```text
//! connection ─► gate (Host, token, Origin, X-Smash) ─► route ─► studio, on a thread of its own
//! (limited)     on every request                                 (fits and diagnoses take time)
//! ```

mod body;
mod connections;
mod gate;
mod guests;
mod port;
mod reply;
mod routes;
mod token;

use std::future::Future;
use std::net::{Ipv4Addr, SocketAddr, TcpListener};
use std::sync::Arc;

use super::Studio;
use crate::files::plain;
use crate::{Error, ErrorKind, Result};
use token::Token;

/// A studio at an address of this machine, which only this machine reaches, and only who knows the
/// token in it.
#[derive(Debug)]
pub struct Server {
    listener: TcpListener,
    address: SocketAddr,
    token: Token,
}

impl Server {
    /// Takes the port at 127.0.0.1; with 0 that of `studio`'s session, or, where it is taken, a free one.
    ///
    /// # Errors
    /// The port is taken, or the system has no randomness.
    pub fn bind(port: u16, studio: &Studio) -> Result<Server> {
        let unusable = |error: std::io::Error| {
            Error::new(ErrorKind::Write, format!("port {port} can't be used: {}", plain(&error)))
                .mend("leave `--port` out for a free one, or name another")
        };
        let listen = |port: u16| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
        let listener = match port {
            0 => listen(port::usual(&studio.session_id)).or_else(|_| listen(0)),
            port => listen(port),
        };
        let listener = listener.map_err(unusable)?;
        listener.set_nonblocking(true).map_err(unusable)?;
        let address = listener.local_addr().map_err(unusable)?;
        Ok(Server { listener, address, token: Token::new()? })
    }

    /// Where the page is. Whoever has it can do all that the page can.
    pub fn address(&self) -> String {
        format!("http://{}/{}/", self.address, self.token.text())
    }

    /// Serves `studio` until `stop` is done, and what was asked before then is answered.
    ///
    /// # Errors
    /// The system gives no threads.
    pub fn run(self, studio: Studio, stop: impl Future<Output = ()>) -> Result<()> {
        let impossible = |error: std::io::Error| {
            Error::new(ErrorKind::Write, format!("the studio can't be served: {}", plain(&error)))
                .mend("end some other programs, and try again")
        };
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .enable_all()
            .build()
            .map_err(impossible)?;
        let served = runtime.block_on(async {
            let listener = tokio::net::TcpListener::from_std(self.listener)?;
            let router = routes::router(Arc::new(studio), self.address.port(), self.token);
            connections::serve(listener, router, stop).await;
            Ok(())
        });
        // A diagnosis may still be on its way: nobody waits for it.
        runtime.shutdown_background();
        served.map_err(impossible)
    }
}
