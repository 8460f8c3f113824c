//! Connections: a limited number, none of which may dawdle over its request.

use std::future::Future;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::TcpListener;
use tokio::sync::Semaphore;
use tokio::time::{sleep, timeout};

/// At once: ten browsers of six connections each, four times.
const MOST_CONNECTIONS: usize = 256;
/// For a request's head, and between two requests.
const LONGEST_HEAD: Duration = Duration::from_secs(10);
/// The largest head, in bytes.
const LARGEST_HEAD: usize = 16 << 10;
/// How long what was asked before the end may still take.
const LONGEST_END: Duration = Duration::from_secs(5);
/// After an error of the system's, such as too many open files.
const PAUSE: Duration = Duration::from_millis(50);

/// Answers by `router` until `stop` is done.
pub(super) async fn serve(listener: TcpListener, router: Router, stop: impl Future<Output = ()>) {
    let free = Arc::new(Semaphore::new(MOST_CONNECTIONS));
    let ending = GracefulShutdown::new();
    tokio::pin!(stop);
    loop {
        let accepted = async {
            // Further ones wait, until one of these ends.
            let place = free.clone().acquire_owned().await;
            (place, listener.accept().await)
        };
        let (place, stream) = tokio::select! {
            () = &mut stop => break,
            (place, accepted) = accepted => match accepted {
                Ok((stream, _)) => (place, stream),
                Err(_) => {
                    sleep(PAUSE).await;
                    continue;
                }
            },
        };
        let service = TowerToHyperService::new(router.clone());
        let connection = http1::Builder::new()
            .timer(TokioTimer::new())
            .header_read_timeout(LONGEST_HEAD)
            .max_buf_size(LARGEST_HEAD)
            .serve_connection(TokioIo::new(stream), service);
        let connection = ending.watch(connection);
        tokio::spawn(async move {
            // Whatever ended it: nobody is left to tell.
            let _ = connection.await;
            drop(place);
        });
    }
    drop(listener);
    let _ = timeout(LONGEST_END, ending.shutdown()).await;
}
