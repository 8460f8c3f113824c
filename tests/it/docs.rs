//! What the documents claim is true: their paths exist, their commands run.
//!
//! Conventions for writers: an `sh` block is run, from a folder that looks like the repository's
//! root, and prints the numbers of the `text` block that follows, if one does before the next `sh`.
//! A `console` block (lines that start with `$ `) is only for the reader, as is any other `text`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use pulldown_cmark::{CodeBlockKind, Event, Parser, Tag, TagEnd};

const ROOT: &str = env!("CARGO_MANIFEST_DIR");
const SMASH: &str = env!("CARGO_BIN_EXE_smash");

/// What a test needs of a Markdown file.
#[derive(Default)]
struct Document {
    name: String,
    /// Inline code, without the backticks.
    code: Vec<String>,
    /// Targets of links and pictures.
    links: Vec<String>,
    scripts: Vec<Script>,
    /// Commands at the prompts of `console` blocks.
    prompts: Vec<String>,
}

/// An `sh` block.
struct Script {
    text: String,
    /// What it prints, says the document.
    output: Option<String>,
}

impl Document {
    fn read(path: &Path) -> Document {
        let text = fs::read_to_string(path).unwrap();
        let mut document = Document { name: path.display().to_string(), ..Document::default() };
        let mut block: Option<(String, String)> = None;
        for event in Parser::new(&text) {
            match (event, &mut block) {
                (Event::Start(Tag::CodeBlock(CodeBlockKind::Fenced(language))), _) => {
                    block = Some((language.to_string(), String::new()));
                }
                (Event::Text(text), Some((_, content))) => content.push_str(&text),
                (Event::End(TagEnd::CodeBlock), _) => {
                    if let Some((language, content)) = block.take() {
                        document.add_block(&language, content);
                    }
                }
                (Event::Code(code), _) => document.code.push(code.to_string()),
                (Event::Start(Tag::Link { dest_url, .. } | Tag::Image { dest_url, .. }), _) => {
                    document.links.push(dest_url.to_string())
                }
                _ => {}
            }
        }
        document
    }

    fn add_block(&mut self, language: &str, content: String) {
        match language {
            "sh" => self.scripts.push(Script { text: content, output: None }),
            "text" => {
                if let Some(script) = self.scripts.last_mut() {
                    script.output.get_or_insert(content);
                }
            }
            "console" => {
                let prompts = content.lines().filter_map(|line| line.strip_prefix("$ "));
                self.prompts.extend(prompts.map(str::to_owned));
            }
            _ => {}
        }
    }

    /// Paths that the document says are in the repository.
    fn paths(&self) -> impl Iterator<Item = &str> {
        let local = |link: &&str| !link.contains(':') && !link.starts_with('#');
        let links = self.links.iter().map(String::as_str).filter(local);
        let code = self.code.iter().map(String::as_str).filter(|code| looks_like_a_path(code));
        links.map(|link| link.split('#').next().unwrap_or(link)).chain(code)
    }
}

/// The Markdown files at the root, and those that explain a folder.
fn documents() -> Vec<Document> {
    let folders = ["", "docs", "scenes", "tests"].map(|folder| Path::new(ROOT).join(folder));
    let entries = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap());
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "md"))
        .collect();
    paths.sort();
    paths.iter().map(|path| Document::read(path)).collect()
}

/// Whether inline code names a place in the repository: `cpp/functors`, `build.rs`, `./setup`;
/// not `m/s`, `result.json` or `/usr/include`.
fn looks_like_a_path(code: &str) -> bool {
    let plain = |c: char| c.is_ascii_alphanumeric() || "._-/".contains(c);
    if !code.chars().all(plain) || code.starts_with('/') || code.starts_with("target/") {
        return false;
    }
    let of_source = [".rs", ".md", ".toml", ".cc", ".h", ".sh"].iter().any(|e| code.ends_with(e));
    match code.split_once('/') {
        None => of_source,
        Some((first, _)) => {
            of_source || code.ends_with('/') || Path::new(ROOT).join(first).exists()
        }
    }
}

#[test]
fn every_path_in_the_documents_exists() {
    let mut named = 0;
    for document in documents() {
        let folder = Path::new(&document.name).parent().unwrap();
        for path in document.paths() {
            named += 1;
            let exists = [Path::new(ROOT), folder].iter().any(|base| base.join(path).exists());
            assert!(exists, "{}: {path} doesn't exist", document.name);
        }
    }
    assert!(named > 50, "only {named} paths found: does the search still work?");
}

#[test]
fn every_command_named_in_the_documents_exists() {
    let mut names: Vec<(String, String)> = Vec::new();
    for document in documents() {
        for line in document.code.iter().chain(&document.prompts) {
            let mut words = line.split_whitespace();
            let program = words.next().unwrap_or_default();
            if Path::new(program).file_name().is_some_and(|name| name == "smash") {
                let command = words.find(|word| word.starts_with(|c: char| c.is_ascii_lowercase()));
                names.extend(command.map(|command| (document.name.clone(), command.to_owned())));
            }
        }
    }
    assert!(!names.is_empty());
    for (document, command) in names {
        let help = Command::new(SMASH).args([&command, "--help"]).output().unwrap();
        assert!(help.status.success(), "{document}: there is no `smash {command}`");
    }
}

#[test]
fn every_script_in_the_documents_runs_and_prints_the_numbers_shown() {
    let mut shown = 0;
    for document in documents() {
        // Outputs land here, beside links to all that the repository holds.
        let folder = tempfile::tempdir().unwrap();
        for entry in fs::read_dir(ROOT).unwrap() {
            let entry = entry.unwrap();
            let is_output = entry.path().extension().is_some_and(|e| e == "json");
            if entry.file_name() != "target" && !is_output {
                std::os::unix::fs::symlink(entry.path(), folder.path().join(entry.file_name()))
                    .unwrap();
            }
        }
        for script in &document.scripts {
            let output = Command::new("bash")
                .args(["-euo", "pipefail", "-c", &script.text])
                .current_dir(folder.path())
                .env("PATH", path_with_smash())
                .output()
                .unwrap();
            let errors = String::from_utf8_lossy(&output.stderr);
            let place = format!("{}:\n{}", document.name, script.text);
            assert!(output.status.success(), "{place}\n{errors}");
            if let Some(claimed) = &script.output {
                shown += 1;
                assert_same_numbers(claimed, &String::from_utf8_lossy(&output.stdout), &place);
            }
        }
    }
    assert!(shown > 0, "the README shows a session");
}

/// Asserts that the numbers in the two texts agree to three digits; words may differ. Three are
/// what a reader compares, and more than another version of Ceres or compiler would change.
fn assert_same_numbers(claimed: &str, printed: &str, place: &str) {
    let (claims, prints) = (numbers(claimed), numbers(printed));
    let is_same = |(claim, print): (&f64, &f64)| {
        // Small numbers are printed with three decimals: there the last one counts.
        (claim - print).abs() <= (5e-3 * print.abs()).max(1.1e-3)
    };
    let agree = claims.len() == prints.len() && claims.iter().zip(&prints).all(is_same);
    assert!(agree, "{place}\nprints\n{printed}\nbut the document says\n{claimed}");
}

fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'));
    words.filter_map(|word| word.trim_end_matches('.').parse().ok()).collect()
}

fn path_with_smash() -> std::ffi::OsString {
    let folder = Path::new(SMASH).parent().unwrap().to_path_buf();
    let others = std::env::var_os("PATH").unwrap();
    std::env::join_paths(std::iter::once(folder).chain(std::env::split_paths(&others))).unwrap()
}
