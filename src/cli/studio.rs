//! `smash studio`: the page, alive.

use std::io::IsTerminal;
use std::path::PathBuf;

use clap::Args;
use serde_json::json;
use smash::Result;
use smash::files::print_bytes;
use smash::report::require_page;
use smash::studio::{Server, Studio};

use super::browser;

/// Opens a scene in the browser: add and remove effects, write laws, mark poses, and see the error fall
///
/// Serves the page to this machine alone, at an address that holds a secret. Everything that is tried
/// is saved at once, in the session's file; started again with it, the studio goes on from there.
/// Ctrl-C ends it.
#[derive(Args)]
pub struct Arguments {
    /// The scene (smash.scene/1), or - for standard input
    scene: PathBuf,
    /// Where the session is saved (smash.session/1); beside the scene as NAME.session.json unless named
    #[arg(long, value_name = "FILE")]
    session: Option<PathBuf>,
    /// The port; the session's own unless named, so that the browser finds again what it keeps
    #[arg(long, value_name = "N", default_value_t = 0, hide_default_value = true)]
    port: u16,
    /// Don't open the browser
    #[arg(long)]
    no_open: bool,
    /// Print the address as JSON instead of words
    #[arg(long)]
    json: bool,
}

/// Opens, tells, serves.
///
/// # Errors
/// The scene or the session can't be opened, the port is taken, or this build has no page.
pub fn run(arguments: &Arguments) -> Result<()> {
    require_page()?;
    let studio = Studio::open(&arguments.scene, arguments.session.as_deref())?;
    super::warn(studio.scene().warnings());
    let server = Server::bind(arguments.port, &studio)?;
    let address = server.address();
    let told = match arguments.json {
        true => format!("{}\n", json!({"address": address, "session": studio.session_file()})),
        false => format!(
            "{address}\n\nThe address is only for you: who has it can do all that the page can.\nAll \
             that you try is saved in {}. Ctrl-C ends the studio.\n",
            studio.session_file()
        ),
    };
    print_bytes(told.as_bytes())?;
    if !arguments.no_open && std::io::stdout().is_terminal() {
        // Where there is no browser, the address stands on the terminal.
        let _ = browser::open(&address);
    }
    server.run(studio, async {
        // Where the signal can't be heard, killing ends it as well: all is saved.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    })
}
