//! All integration tests, in one binary: one module a topic. `tests/README.md` says what each
//! kind of test proves.

mod collision;
mod docs;
mod free_rotation;
mod installation;
mod simulate;
