//! `smash effects`: the catalogue, and the user's own effects.

use std::path::{Path, PathBuf};

use serde::Serialize;
use smash::Error;
use smash::effect::{Effect, Parameter, Scope, catalogue, find};
use smash::files::{print_bytes, shell_word};

use super::table::{aligned, lines};

/// Shows the effects that a model can be given, and checks effect files
#[derive(clap::Args)]
pub struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(clap::Subcommand)]
enum Task {
    /// Lists the catalogue
    List {
        /// Print JSON instead of text
        #[arg(long)]
        json: bool,
    },
    /// Shows an effect: its law, its parameters, how it looks, what it is confused with
    Show {
        /// A name of the catalogue, or the path of an effect file
        name: String,
        /// Print JSON instead of text
        #[arg(long)]
        json: bool,
    },
    /// Checks an effect file: its units, that it does nothing at the null values, its derivatives
    Check {
        /// The effect file (TOML); `-` is standard input
        file: PathBuf,
        /// Print JSON instead of text
        #[arg(long)]
        json: bool,
    },
}

/// Lists, shows or checks.
///
/// # Errors
/// There is no such effect, or its file isn't good.
pub fn run(arguments: &Arguments) -> smash::Result<()> {
    match &arguments.task {
        Task::List { json } => print(*json, catalogue(), || list(catalogue())),
        Task::Show { name, json } => {
            let effect = find(name)?;
            print(*json, &*effect, || described(&effect, name))
        }
        Task::Check { file, json } => {
            let effect = Effect::read(file).map_err(|error| of_the_catalogue(error, file))?;
            print(*json, &effect, || passed(&effect, &file.display().to_string()))
        }
    }
}

/// Whoever checks an effect of the catalogue by its name is told that it is built in.
fn of_the_catalogue(error: Error, file: &Path) -> Error {
    let is_it = |effect: &&Effect| Path::new(&effect.name) == file && !file.exists();
    match catalogue().iter().find(is_it) {
        Some(Effect { name, .. }) => error.mend(format!(
            "{name} is built in, and needs no check; this shows it: smash effects show {name}"
        )),
        None => error,
    }
}

fn print<T: Serialize + ?Sized>(
    as_json: bool,
    value: &T,
    in_words: impl Fn() -> String,
) -> smash::Result<()> {
    let mut text = if as_json {
        serde_json::to_string_pretty(value).expect("effects hold text and finite numbers")
    } else {
        in_words()
    };
    if !text.ends_with('\n') {
        text.push('\n');
    }
    print_bytes(text.as_bytes())
}

fn list(effects: &[Effect]) -> String {
    let row = |effect: &Effect| {
        vec![effect.name.clone(), owner(effect.scope).to_owned(), effect.title.clone()]
    };
    let rows: Vec<_> = effects.iter().map(row).collect();
    format!("{}\nNext\n  smash effects show {}\n", aligned(&rows), effects[0].name)
}

fn described(effect: &Effect, asked: &str) -> String {
    let laws = effect.sources.iter().map(|(hook, law)| vec![hook.to_string(), law.clone()]);
    let mut text = format!(
        "{}: {}\n\nLaw, on {}\n{}\nParameters\n{}",
        effect.name,
        effect.title,
        owner(effect.scope),
        aligned(&laws.collect::<Vec<_>>()),
        parameters(&effect.parameters),
    );
    let help = &effect.help;
    let needs: Vec<_> = effect.needs.iter().map(|need| need.in_words()).collect();
    for (title, words) in [
        ("Needs", needs.join(", ")),
        ("Looks like", help.looks_like.clone()),
        ("Confused with", help.confused_with.join(", ")),
        ("To tell them apart", help.tell_apart.clone()),
        ("Source", help.source.clone()),
    ] {
        if !words.is_empty() {
            text.push_str(&format!("\n{title}\n  {words}\n"));
        }
    }
    format!("{text}\nNext\n  smash reconstruct SCENE --with {}\n", shell_word(asked))
}

/// A row of numbers, and its size in words below.
fn parameters(parameters: &[Parameter]) -> String {
    let rows: Vec<_> = parameters.iter().map(row).collect();
    let typical = parameters.iter().map(|parameter| match parameter.typical.as_str() {
        "" => String::new(),
        words => format!("    {words}\n"),
    });
    lines(&rows).iter().zip(typical).map(|(row, words)| format!("  {row}\n{words}")).collect()
}

fn row(parameter: &Parameter) -> Vec<String> {
    let [low, high] = parameter.bounds;
    let null: Vec<_> = parameter.null.iter().map(f64::to_string).collect();
    let null =
        if let [single] = null.as_slice() { single } else { &format!("[{}]", null.join(", ")) };
    let unit = parameter.unit.to_string();
    vec![parameter.name.clone(), unit, format!("null {null}, {low} to {high}")]
}

fn passed(effect: &Effect, file: &str) -> String {
    let hooks: Vec<_> = effect.sources.keys().map(|hook| hook.name()).collect();
    format!(
        "{file}: `{}` is good: {}\n  its units fit, it does nothing at its null values, and its \
         values and slopes are finite, also at rest and without spin\n\nNext\n  \
         smash reconstruct SCENE --with {}\n",
        effect.name,
        hooks.join(", "),
        if file == "-" { file.into() } else { shell_word(file) },
    )
}

fn owner(scope: Scope) -> &'static str {
    match scope {
        Scope::Body => "each body",
        Scope::Scene => "the scene",
        Scope::Contact => "the contact",
    }
}
