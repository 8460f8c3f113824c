//! The files of users' own laws, for the commands that make a result again.

use std::path::Path;

use smash::effect::{Effect, EffectRequest};
use smash::files::shell_word;
use smash::reconstruct::Options;

/// Each law and its file: the one that it was read from, or, where that isn't there or says something
/// else by now, one to be written.
pub struct LawFiles(Vec<LawFile>);

struct LawFile {
    effect: Effect,
    path: String,
    is_there: bool,
}

impl LawFiles {
    /// Of these laws.
    pub fn of(laws: &[EffectRequest]) -> LawFiles {
        let mut files: Vec<LawFile> = Vec::new();
        for EffectRequest { effect, .. } in laws {
            let file = match effect.file.as_ref().filter(|path| holds(path, effect)) {
                Some(path) => {
                    LawFile { effect: effect.clone(), path: path.clone(), is_there: true }
                }
                None => {
                    let named = |path: &String| files.iter().any(|file| file.path == *path);
                    let mut path = format!("{}.toml", effect.name);
                    let mut number = 2;
                    while named(&path) || Path::new(&path).exists() {
                        path = format!("{}-{number}.toml", effect.name);
                        number += 1;
                    }
                    LawFile { effect: effect.clone(), path, is_there: false }
                }
            };
            files.push(file);
        }
        LawFiles(files)
    }

    /// What writes those that aren't there.
    pub fn commands(&self) -> Vec<String> {
        let missing = self.0.iter().filter(|file| !file.is_there);
        missing
            .map(|file| {
                let text = shell_word(&file.effect.to_toml());
                format!("printf %s {text} > {}", shell_word(&file.path))
            })
            .collect()
    }

    /// The file of a law as a word of a command.
    pub fn word(&self, law: &EffectRequest) -> String {
        shell_word(&EffectRequest { effect: self.filed(&law.effect), ..law.clone() }.to_string())
    }

    /// The same options, with each law from its file.
    pub fn named(&self, mut options: Options) -> Options {
        if let Options::Refined(refined) = &mut options {
            for request in &mut refined.effects {
                request.effect = self.filed(&request.effect);
            }
        }
        options
    }

    /// One of the catalogue needs no file.
    fn filed(&self, effect: &Effect) -> Effect {
        let file = self.0.iter().find(|file| file.effect == *effect).map(|file| file.path.clone());
        Effect { file, ..effect.clone() }
    }
}

/// Whether the file at `path` says the same as `effect`. A pipe is never read: it might wait.
fn holds(path: &str, effect: &Effect) -> bool {
    Path::new(path).is_file() && Effect::read(path).is_ok_and(|read| read == *effect)
}
