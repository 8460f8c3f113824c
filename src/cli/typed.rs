//! What was typed, for the commands that a person may type next.

use std::path::{Path, PathBuf};

use smash::effect::EffectRequest;
use smash::files::shell_word;
use smash::reconstruct::{Options, RefinedOptions};

use super::again;
use super::law_files::LawFiles;

/// Scenes and options, as they were typed.
pub struct Typed {
    scenes: Vec<String>,
    options: RefinedOptions,
    /// Further candidates.
    further: Vec<EffectRequest>,
    laws: LawFiles,
}

impl Typed {
    /// Of a command with these arguments.
    pub fn new(scenes: &[PathBuf], options: &RefinedOptions, further: &[EffectRequest]) -> Typed {
        let laws = LawFiles::of(options.effects.iter().chain(further));
        let filed = |effects: &[EffectRequest]| effects.iter().map(|one| laws.filed(one)).collect();
        Typed {
            scenes: scenes.iter().map(|path| scene_word(path)).collect(),
            options: RefinedOptions { effects: filed(&options.effects), ..options.clone() },
            further: filed(further),
            laws,
        }
    }

    /// Of a command that takes a scene and nothing else.
    pub fn of_scene(scene: &Path) -> Typed {
        Typed::new(&[scene.to_path_buf()], &RefinedOptions::default(), &[])
    }

    /// Whether it took several scenes.
    pub fn has_several_scenes(&self) -> bool {
        self.scenes.len() > 1
    }

    /// Lines of advice, completed; before them what keeps a law that no file holds and that they need.
    pub fn advice(&self, lines: &[String]) -> Vec<String> {
        let lines: Vec<String> = lines.iter().map(|line| self.completed(line)).collect();
        let keep = self.writing(&lines).into_iter();
        keep.map(|command| format!("keep the law, which no file holds: {command}"))
            .chain(lines)
            .collect()
    }

    /// What a line of advice takes for the effects that were typed.
    pub fn given(&self) -> String {
        let label = |request: &EffectRequest| {
            let body = request.body.as_ref().map_or(String::new(), |body| format!("@{body}"));
            format!(" --with {}{body}", request.effect.name)
        };
        self.options.effects.iter().map(label).collect()
    }

    /// What writes the laws that no file holds and that `commands` need.
    pub fn writing(&self, commands: &[String]) -> Vec<String> {
        self.laws.writing(commands)
    }

    /// A line of advice with the scene's own path for SCENE, and effects as they were typed.
    fn completed(&self, line: &str) -> String {
        let (one, options) = (self.scene(), self.flags());
        let several = match self.scenes.as_slice() {
            [one] => format!("{one} OTHER_SCENE …"),
            all => all.join(" "),
        };
        let line = line
            .replace("SCENE SCENE …", &format!("{several}{options}"))
            .replace("compare SCENE", &format!("compare {one}"))
            .replace("cut SCENE", &format!("cut {one}"))
            .replace(" SCENE ", &format!(" {one}{options} "));
        let line = line
            .strip_suffix(" SCENE")
            .map_or(line.clone(), |start| format!("{start} {one}{options}"));
        let mut words = line.split(' ');
        let mut completed: Vec<String> = words.next().map(String::from).into_iter().collect();
        for word in words {
            let is_effect = completed.last().is_some_and(|before| before == "--with");
            completed.push(match self.numbered(word) {
                Some(scene) => scene.to_string(),
                None if is_effect => self.effect(word),
                None => word.to_string(),
            });
        }
        completed.join(" ")
    }

    /// The scene that `word` stands for, SCENE_1 and so on.
    fn numbered(&self, word: &str) -> Option<&String> {
        let number: usize = word.strip_prefix("SCENE_")?.parse().ok()?;
        self.scenes.get(number.checked_sub(1)?)
    }

    /// The command that reconstructs the scene with `labels` beside the effects that were typed.
    pub fn reconstruction(&self, labels: &[String]) -> String {
        let typed = again::reconstruction(self.scene(), &Options::Refined(self.options.clone()));
        let further = labels.iter().map(|label| format!(" --with {}", self.effect(label)));
        format!("{typed}{}", further.collect::<String>())
    }

    fn flags(&self) -> String {
        again::flags(&Options::Refined(self.options.clone()))
    }

    /// The scene; of several any.
    fn scene(&self) -> &str {
        match self.scenes.as_slice() {
            [scene] => scene,
            _ => "SCENE",
        }
    }

    /// What to type for the effect with this label, `NAME@BODY` or `NAME@BODY:k=0.03`: of a file its
    /// path, and values that are given.
    fn effect(&self, label: &str) -> String {
        let (plain, values) = match label.split_once(':') {
            Some((plain, values)) => (plain, Some(values)),
            None => (label, None),
        };
        let (name, body) = match plain.split_once('@') {
            Some((name, body)) => (name, Some(body)),
            None => (plain, None),
        };
        let is_it = |request: &EffectRequest| {
            request.effect.name == name
                && (request.body.is_none() || request.body.as_deref() == body)
        };
        let mut known = self.options.effects.iter().chain(&self.further);
        let Some(request) = known.find(|request| is_it(request)) else {
            return shell_word(label);
        };
        let mut request = EffectRequest { body: body.map(String::from), ..request.clone() };
        let Some(values) = values else { return shell_word(&request.to_string()) };
        // They hold the given ones, too.
        request.fixed.clear();
        shell_word(&format!("{request}:{values}"))
    }
}

/// A scene as a word of the shell. Standard input has no name to type.
fn scene_word(path: &Path) -> String {
    match path == Path::new("-") {
        true => "SCENE".to_string(),
        false => shell_word(&path.to_string_lossy()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Advice that adds a law keeps what was typed already, with its file and values.
    #[test]
    fn advice_keeps_the_effects_that_were_given() {
        let tether = "examples/effects/tether.toml";
        let given = EffectRequest::parse(&format!("{tether}@ball:length=0.5")).unwrap();
        let options = RefinedOptions { effects: vec![given], ..RefinedOptions::default() };
        let typed = Typed::new(&[PathBuf::from("a.json")], &options, &[]);
        let line = format!("add it: smash improve SCENE{} --with ./law.toml@ball", typed.given());
        assert_eq!(
            typed.advice(&[line]),
            [format!(
                "add it: smash improve a.json --with {tether}@ball:length=0.5 --with ./law.toml@ball"
            )]
        );
    }

    /// Of several throws a label carries the values that they share, those that were given among them.
    #[test]
    fn a_law_with_shared_values_is_typed_by_its_file() {
        let tether = "examples/effects/tether.toml";
        let given = EffectRequest::parse(&format!("{tether}@ball:length=0.5")).unwrap();
        let scenes = [PathBuf::from("a.json"), PathBuf::from("b.json")];
        let typed = Typed::new(&scenes, &RefinedOptions::default(), &[given]);
        let with = |label: &str| typed.reconstruction(&[label.to_string()]);
        let start = format!("smash reconstruct SCENE --with {tether}@ball");
        assert_eq!(with("tether@ball"), format!("{start}:length=0.5"));
        let shared = "length=0.5,stiffness=0.25";
        assert_eq!(with(&format!("tether@ball:{shared}")), format!("{start}:{shared}"));
        assert_eq!(with("magnus@a:k=0.1"), "smash reconstruct SCENE --with magnus@a:k=0.1");
    }

    /// Standard input has no name to type.
    #[test]
    fn a_scene_from_standard_input_stays_a_placeholder() {
        let typed = Typed::of_scene(Path::new("-"));
        assert_eq!(typed.reconstruction(&[]), "smash reconstruct SCENE");
        let line = "look for more: smash improve SCENE".to_string();
        assert_eq!(typed.advice(std::slice::from_ref(&line)), [line]);
    }
}
