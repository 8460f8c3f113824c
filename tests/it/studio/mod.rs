//! `smash studio` over its sockets, as a browser, a careless program or a stranger meets it.

mod acts;
mod diagnosis;
mod files;
mod gate;
mod laws;
mod many;
mod running;
mod sessions;
mod slow;
mod strangers;

pub use running::Running;
