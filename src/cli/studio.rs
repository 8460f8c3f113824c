//! `smash studio`: the page, alive.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;
use smash::files::{display_name, print_bytes};
use smash::report::require_page;
use smash::studio::{Server, Studio};
use smash::{Error, ErrorKind, Result};

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
    let studio = Studio::open(&arguments.scene, arguments.session.as_deref())
        .map_err(|error| of_session(error, &arguments.scene))?;
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
        browser::open(&address);
    }
    server.run(studio, async {
        // Where the signal can't be heard, killing ends it as well: all is saved.
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    })
}

/// An error that is about the session's file, with the way on without it.
fn of_session(error: Error, scene: &Path) -> Error {
    let is_scenes = error.file() == Some(display_name(scene, "standard input").as_str());
    let is_broken = matches!(error.kind(), ErrorKind::Read | ErrorKind::Parse | ErrorKind::Invalid);
    let hint = error.hint().unwrap_or_default().to_string();
    if is_scenes || !is_broken || hint.contains("--session") {
        return error;
    }
    let way_on = "move it away, or give `--session OTHER`, to start anew";
    error.mend(if hint.is_empty() { way_on.to_string() } else { format!("{hint}; or {way_on}") })
}
