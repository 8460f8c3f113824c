//! Who is connected. Where another one wants in, a guest who asks nothing has to leave; where all ask,
//! one whose request isn't whole yet, or who is slow to take the answer.

use std::collections::VecDeque;
use std::io;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU8, Ordering};
use std::task::{Context, Poll};

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::Request;
use axum::middleware::Next;
use axum::response::Response;
use hyper::body::{Frame, SizeHint};
use tokio::io::{AsyncRead, AsyncWrite, ReadBuf};
use tokio::net::TcpStream;
use tokio::task::AbortHandle;

/// How far a guest's request has come.
#[derive(Debug, Clone, Default)]
pub(super) struct Asked(Arc<Progress>);

#[derive(Debug, Default)]
struct Progress {
    /// `IDLE`, `SENDING` or `ASKED`.
    request: AtomicU8,
    /// An answer waits for the guest to take more of it.
    is_waited_for: AtomicBool,
}

/// No request's head is there, or it is answered.
const IDLE: u8 = 0;
/// Its body is on its way.
const SENDING: u8 = 1;
/// The answer is on its way.
const ANSWERED: u8 = 2;
/// It is whole, and isn't answered yet: nobody leaves so.
const ASKED: u8 = 3;

/// Those who are connected, who came first in front.
#[derive(Debug, Default)]
pub(super) struct Guests(VecDeque<(Asked, AbortHandle)>);

impl Guests {
    /// Whether there is a place among `most`, made by sending the first of those away who have come the
    /// least far.
    pub(super) fn have_place(&mut self, most: usize) -> bool {
        self.0.retain(|(_, task)| !task.is_finished());
        if self.0.len() < most {
            return true;
        }
        let far = self.0.iter().map(|(asked, _)| asked.get()).enumerate();
        let least = far.filter(|(_, far)| *far < ASKED).min_by_key(|(_, far)| *far);
        let leaves = least.and_then(|(index, _)| self.0.remove(index));
        leaves.iter().for_each(|(_, task)| task.abort());
        leaves.is_some()
    }

    pub(super) fn welcome(&mut self, asked: Asked, task: AbortHandle) {
        self.0.push_back((asked, task));
    }
}

impl Asked {
    fn get(&self) -> u8 {
        let request = self.0.request.load(Ordering::Relaxed);
        if self.0.is_waited_for.load(Ordering::Relaxed) { request.max(ANSWERED) } else { request }
    }

    fn set(&self, request: u8) {
        self.0.request.store(request, Ordering::Relaxed);
    }
}

/// Notes when a request is whole, and when it is answered.
pub(super) async fn note(asked: Asked, request: Request, next: Next) -> Response {
    asked.set(if request.body().is_end_stream() { ASKED } else { SENDING });
    let noted = asked.clone();
    let response = next.run(request.map(|body| Body::new(Coming { body, asked: noted }))).await;
    asked.set(IDLE);
    response
}

/// A request's body, which notes its end.
struct Coming {
    body: Body,
    asked: Asked,
}

impl HttpBody for Coming {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let polled = Pin::new(&mut self.body).poll_frame(context);
        if matches!(polled, Poll::Ready(None)) || self.body.is_end_stream() {
            self.asked.set(ASKED);
        }
        polled
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

/// A guest's stream, which notes when an answer waits.
pub(super) struct Stream {
    pub(super) stream: TcpStream,
    pub(super) asked: Asked,
}

impl AsyncRead for Stream {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl AsyncWrite for Stream {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let polled = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.asked.0.is_waited_for.store(polled.is_pending(), Ordering::Relaxed);
        polled
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
