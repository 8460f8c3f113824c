//! The files of users' own laws, for the commands that make a result again.

use std::path::Path;

use smash::effect::{Effect, EffectRequest, catalogue};
use smash::files::shell_word;
use smash::reconstruct::Options;

/// Each law and its file: the one that it was read from, or, where there is none or it says something
/// else by now, one to be written.
pub struct LawFiles(Vec<LawFile>);

struct LawFile {
    effect: Effect,
    path: String,
    is_there: bool,
}

impl LawFiles {
    /// Of the users' own among these effects.
    pub fn of<'a>(effects: impl IntoIterator<Item = &'a EffectRequest>) -> LawFiles {
        let mut files: Vec<LawFile> = Vec::new();
        for EffectRequest { effect, .. } in effects {
            let is_known = files.iter().any(|file| file.effect == *effect);
            if !is_known && !catalogue().contains(effect) {
                files.push(file_of(effect, &files));
            }
        }
        LawFiles(files)
    }

    /// What writes those that `commands` need and that aren't there.
    pub fn writing(&self, commands: &[String]) -> Vec<String> {
        let is_needed = |file: &&LawFile| {
            let word = shell_word(&file.path);
            let word = word.trim_matches('\'');
            !file.is_there && commands.iter().any(|command| command.contains(word))
        };
        let missing = self.0.iter().filter(is_needed);
        missing
            .map(|file| {
                let text = shell_word(&file.effect.to_toml());
                format!("printf %s {text} > {}", shell_word(&file.path))
            })
            .collect()
    }

    /// The same effect, with its law from its file; one of the catalogue needs none.
    pub fn filed(&self, request: &EffectRequest) -> EffectRequest {
        let file = self.0.iter().find(|file| file.effect == request.effect);
        let file = file.map(|file| file.path.clone());
        EffectRequest { effect: Effect { file, ..request.effect.clone() }, ..request.clone() }
    }

    /// The same options, with each law from its file.
    pub fn named(&self, mut options: Options) -> Options {
        if let Options::Refined(refined) = &mut options {
            for request in &mut refined.effects {
                *request = self.filed(request);
            }
        }
        options
    }
}

/// The file that `effect` was read from, or else one beside those of `others`: NAME.toml, NAME-2.toml …
fn file_of(effect: &Effect, others: &[LawFile]) -> LawFile {
    let file =
        |path: &String, is_there| LawFile { effect: effect.clone(), path: path.clone(), is_there };
    if let Some(path) = effect.file.as_ref().filter(|path| holds(path, effect)) {
        return file(path, true);
    }
    let mut path = format!("{}.toml", effect.name);
    let mut number = 2;
    loop {
        let is_taken = others.iter().any(|other| other.path == path);
        match Path::new(&path).exists() {
            false if !is_taken => return file(&path, false),
            true if holds(&path, effect) => return file(&path, true),
            _ => path = format!("{}-{number}.toml", effect.name),
        }
        number += 1;
    }
}

/// Whether the file at `path` says the same as `effect`. A pipe is never read: it might wait.
fn holds(path: &str, effect: &Effect) -> bool {
    Path::new(path).is_file() && Effect::read(path).is_ok_and(|read| read == *effect)
}
