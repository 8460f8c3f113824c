//! Who is connected. A guest whose request isn't whole has to leave where another one wants in.

use std::collections::VecDeque;
use std::pin::Pin;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::task::{Context, Poll};

use axum::body::{Body, Bytes, HttpBody};
use axum::extract::Request;
use axum::middleware::Next;
use axum::response::Response;
use hyper::body::{Frame, SizeHint};
use tokio::task::AbortHandle;

/// Whether a guest's request has come to its end, and isn't answered yet.
#[derive(Debug, Clone, Default)]
pub(super) struct Asked(Arc<AtomicBool>);

/// Those who are connected, who came first in front.
#[derive(Debug, Default)]
pub(super) struct Guests(VecDeque<(Asked, AbortHandle)>);

impl Guests {
    /// Whether there is a place among `most`, made by sending the first away who doesn't ask anything.
    pub(super) fn have_place(&mut self, most: usize) -> bool {
        self.0.retain(|(_, task)| !task.is_finished());
        if self.0.len() < most {
            return true;
        }
        let idle = self.0.iter().position(|(asked, _)| !asked.0.load(Ordering::Relaxed));
        let idle = idle.and_then(|index| self.0.remove(index));
        idle.iter().for_each(|(_, task)| task.abort());
        idle.is_some()
    }

    pub(super) fn welcome(&mut self, asked: Asked, task: AbortHandle) {
        self.0.push_back((asked, task));
    }
}

/// Notes when a request is whole, and when it is answered.
pub(super) async fn note(asked: Asked, request: Request, next: Next) -> Response {
    let note = asked.clone();
    note.0.store(request.body().is_end_stream(), Ordering::Relaxed);
    let response = next.run(request.map(|body| Body::new(Noted { body, asked }))).await;
    note.0.store(false, Ordering::Relaxed);
    response
}

/// A body that notes its end.
struct Noted {
    body: Body,
    asked: Asked,
}

impl HttpBody for Noted {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        let polled = Pin::new(&mut self.body).poll_frame(context);
        if matches!(polled, Poll::Ready(None)) || self.body.is_end_stream() {
            self.asked.0.store(true, Ordering::Relaxed);
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
