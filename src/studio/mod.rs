//! The studio: models of one scene, tried one after the other, with nothing lost.
//!
//! ```text
//! action ─► session (tree of variants, draft) ─► fits (warm) ─► report ─┬─► state ─► page
//!                │                                                      │
//!                └─────────────► session file, before the answer        └─► diagnosis, on demand
//! ```

mod action;
mod action_fields;
mod content;
mod diagnoses;
mod edits;
mod file;
mod fits;
mod kept;
mod law;
mod lock;
mod model;
mod place;
mod save;
mod server;
mod session;
mod session_scene;
mod shown;
mod state;
mod tree;

use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

pub use action::{Action, Change, Step};
pub use edits::{Edits, MovedPose, NoisyPose, Pose};
pub use file::{SESSION_SCHEMA, SessionFile, SessionVariant};
pub use law::{LawCheck, LawEffect, LawMistake};
pub use server::Server;
pub use session_scene::SessionScene;
pub use state::{CatalogueEffect, LawView, Limits, STUDIO_SCHEMA, StudioState, VariantView};
pub use tree::Numbers;

use diagnoses::Diagnoses;
use file::{LARGEST_SESSION_BYTES, LONGEST_DRAFT_BYTES};
use fits::Fits;
use save::Save;
use session::Session;
use shown::Shown;

use crate::files::{display_name, read_text, sha256, shell_word};
use crate::{Error, Result, Scene};

/// A scene, and a session of models of it. Any number of threads may use it at once.
#[derive(Debug)]
pub struct Studio {
    scene: Arc<Scene>,
    /// How to name it in a command.
    scene_word: String,
    /// The scene as the session's file names it.
    identity: SessionScene,
    session_file: String,
    /// What tells that file from all others: a hash of its whole path.
    session_id: String,
    /// What is seen; held for moments only.
    shown: Mutex<Arc<Shown>>,
    /// Whoever holds this changes what is seen: one after the other.
    acting: Mutex<Acting>,
    diagnoses: Diagnoses,
}

/// What acts work with.
#[derive(Debug)]
struct Acting {
    fits: Fits,
    save: Save,
}

impl Studio {
    /// Opens the scene at `scene` with the session at `session`, which may not be there yet; by
    /// default it stands beside the scene: `NAME.session.json` beside `NAME.json`.
    ///
    /// # Errors
    /// The scene isn't one or can't be fitted; the session is another scene's or broken, or couldn't be
    /// written.
    pub fn open(scene: &Path, session: Option<&Path>) -> Result<Studio> {
        let scene_file = display_name(scene, "standard input");
        let text = read_text(scene)?;
        let mut save = Save::open(scene, session)?;
        let scene_path = scene;
        let scene = Arc::new(Scene::parse(&text, &scene_file)?);
        let identity = SessionScene::of(&scene, &text);
        let saved = save.read()?;
        let session = match &saved {
            Some(text) => SessionFile::parse(text, save.name())?
                .session(&scene, &identity)
                .map_err(|error| error.in_file(save.name()))?,
            None => Session::new(),
        };
        let mut fits = Fits::new(scene.clone());
        let started = Instant::now();
        let mut shown = Shown::new(session, 1, &scene, &mut fits)
            .map_err(|error| error.in_file(&scene_file))?;
        if saved.is_none() {
            shown.took(started);
        }
        Ok(Studio {
            scene,
            scene_word: match scene_path == Path::new("-") {
                // It has no name to type.
                true => "SCENE".to_string(),
                false => shell_word(&scene_file),
            },
            identity,
            session_file: save.name().to_string(),
            session_id: sha256(&save.path().to_string_lossy())[..16].to_string(),
            shown: Mutex::new(Arc::new(shown)),
            acting: Mutex::new(Acting { fits, save }),
            diagnoses: Diagnoses::new()?,
        })
    }

    /// The scene, as it was read.
    pub fn scene(&self) -> &Scene {
        &self.scene
    }

    /// What is seen now.
    pub fn state(&self) -> StudioState {
        self.state_of(&self.shown())
    }

    /// The number of what is seen now, as in its state.
    pub fn revision(&self) -> u64 {
        self.shown().revision
    }

    /// Does `action`, saves the session, and tells what is seen then.
    ///
    /// # Errors
    /// It can't be done, a model can't be fitted, or the session can't be saved; nothing is changed.
    pub fn act(&self, action: Action) -> Result<StudioState> {
        let mut acting = locked(&self.acting);
        let started = Instant::now();
        let before = self.shown();
        let (session, has_grown) = before.session.after(&self.scene, action)?;
        let mut after = self.fitted(&mut acting, session, &before)?;
        if has_grown {
            after.took(started);
        }
        let shown = self.show(&mut acting, after)?;
        Ok(self.state_of(&shown))
    }

    /// Keeps the draft of a law, and tells what is wrong with it; with `instead_of` only in
    /// the place of that.
    ///
    /// # Errors
    /// It is too long, another draft than `instead_of` is there, or the session can't be saved.
    pub fn check_law(&self, draft: &str, instead_of: Option<&str>) -> Result<LawCheck> {
        if draft.len() > LONGEST_DRAFT_BYTES {
            let problem = format!("is longer than {} KiB", LONGEST_DRAFT_BYTES >> 10);
            return Err(Error::invalid("draft", problem).mend("a law is a page of text"));
        }
        let mut acting = locked(&self.acting);
        let mut shown = self.shown();
        if shown.session.draft != draft {
            if instead_of.is_some_and(|known| known != shown.session.draft) {
                return Err(Error::invalid("instead_of", "isn't the draft that is there")
                    .mend("look at the state's `draft`, and decide which one is to stay"));
            }
            let mut after = (*shown).clone();
            after.revision += 1;
            after.session.draft = draft.to_string();
            shown = self.show(&mut acting, after)?;
        }
        Ok(law::check(&self.scene, draft, shown.revision))
    }

    /// Where the session is saved.
    pub fn session_file(&self) -> &str {
        &self.session_file
    }

    /// `session` with its fits, to come after `before`.
    fn fitted(&self, acting: &mut Acting, session: Session, before: &Shown) -> Result<Shown> {
        Shown::new(session, before.revision + 1, &self.scene, &mut acting.fits)
    }

    /// Saves what is to be seen, and then shows it.
    fn show(&self, acting: &mut Acting, after: Shown) -> Result<Arc<Shown>> {
        let file = SessionFile::of(&after.session, &self.identity);
        acting.save.write(&file.to_json()?)?;
        let after = Arc::new(after);
        *locked(&self.shown) = after.clone();
        Ok(after)
    }

    fn state_of(&self, shown: &Shown) -> StudioState {
        let mut state = shown.state(&self.scene, &self.session_id, &self.session_file);
        state.report.commands = self.commands();
        state
    }

    /// What to type to see the same again.
    fn commands(&self) -> Vec<String> {
        let session = shell_word(&self.session_file);
        vec![format!("smash studio {} --session {session}", self.scene_word)]
    }

    fn shown(&self) -> Arc<Shown> {
        locked(&self.shown).clone()
    }
}

/// What a panicked thread left is whole: it is only ever replaced.
fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
