//! The worked examples of user laws, as files and in the guide.

use std::fs;
use std::path::Path;

use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};
use smash::effect::{Effect, find};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

#[test]
fn the_worked_laws_are_good() {
    for name in ["coriolis", "growing_force", "spring", "tether", "thrust", "wind"] {
        let path = Path::new(ROOT).join(format!("examples/effects/{name}.toml"));
        let effect = Effect::read(path).unwrap();
        assert_eq!(effect.name, name);
        for rival in &effect.help.confused_with {
            find(rival).unwrap();
        }
    }
}

/// The guide's law is that of the file, shorter of what is for people.
#[test]
fn the_guide_shows_the_tether() {
    let text = fs::read_to_string(Path::new(ROOT).join("docs/effects.md")).unwrap();
    let mut laws = Vec::new();
    let mut block: Option<String> = None;
    for event in Parser::new(&text) {
        match (event, &mut block) {
            (Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(kind))), _) if &*kind == "toml" => {
                block = Some(String::new());
            }
            (Event::Text(text), Some(content)) => content.push_str(&text),
            (Event::End(TagEnd::CodeBlock), _) => laws.extend(block.take()),
            _ => {}
        }
    }
    let [law] = laws.as_slice() else { panic!("the guide shows one law, not {}", laws.len()) };
    let shown = Effect::parse(law, "docs/effects.md").unwrap();
    let file = Effect::read(Path::new(ROOT).join("examples/effects/tether.toml")).unwrap();
    assert_eq!(shown.laws, file.laws);
}
