//! Connections: a limited number, none of which may dawdle over its request, nor keep others out.

use std::future::Future;
use std::time::Duration;

use axum::{Router, middleware};
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::time::{sleep, timeout};

use super::guests::{Asked, Guests, Stream, note};

/// At once: ten browsers of six connections each, four times.
const MOST_CONNECTIONS: usize = 256;
/// For a request's head, and between two requests.
const LONGEST_HEAD: Duration = Duration::from_secs(10);
/// The largest head, in bytes.
const LARGEST_HEAD: usize = 16 << 10;
/// How long what was asked before the end may still take.
const LONGEST_END: Duration = Duration::from_secs(5);
/// After an error of the system's, such as too many open files, or where all places are taken.
const PAUSE: Duration = Duration::from_millis(50);

/// Answers by `router` until `stop` is done.
pub(super) async fn serve(listener: TcpListener, router: Router, stop: impl Future<Output = ()>) {
    let mut guests = Guests::default();
    let ending = GracefulShutdown::new();
    tokio::pin!(stop);
    loop {
        let accepted = async {
            // Where all are asking, one of them will be answered.
            while !guests.have_place(MOST_CONNECTIONS) {
                sleep(PAUSE).await;
            }
            listener.accept().await
        };
        let accepted = tokio::select! {
            () = &mut stop => break,
            accepted = accepted => accepted,
        };
        let Ok((stream, _)) = accepted else {
            sleep(PAUSE).await;
            continue;
        };
        let asked = Asked::default();
        let noted = asked.clone();
        let noted = middleware::from_fn(move |request, next| note(noted.clone(), request, next));
        let service = TowerToHyperService::new(router.clone().layer(noted));
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(LONGEST_HEAD)
            .max_buf_size(LARGEST_HEAD)
            .serve_connection(TokioIo::new(Stream { stream, asked: asked.clone() }), service);
        let connection = ending.watch(connection);
        let task = tokio::spawn(async move {
            // Whatever ended it: nobody is left to tell.
            let _ = connection.await;
        });
        guests.welcome(asked, task.abort_handle());
    }
    drop(listener);
    let _ = timeout(LONGEST_END, ending.shutdown()).await;
}
