//! The effects that are built in.

use std::borrow::Cow;
use std::path::Path;
use std::sync::LazyLock;

use super::Effect;
use crate::words::{did_you_mean, quoted};
use crate::{Error, ErrorKind, Result};

/// The files, in the order in which people read them: forces, the body, the contact, the camera.
const FILES: [(&str, &str); 16] = [
    ("effects/linear_drag.toml", include_str!("../../effects/linear_drag.toml")),
    ("effects/quadratic_drag.toml", include_str!("../../effects/quadratic_drag.toml")),
    ("effects/magnus.toml", include_str!("../../effects/magnus.toml")),
    ("effects/constant_force.toml", include_str!("../../effects/constant_force.toml")),
    ("effects/gravity_scale.toml", include_str!("../../effects/gravity_scale.toml")),
    ("effects/gravity_tilt.toml", include_str!("../../effects/gravity_tilt.toml")),
    ("effects/spin_drag.toml", include_str!("../../effects/spin_drag.toml")),
    ("effects/inertia.toml", include_str!("../../effects/inertia.toml")),
    ("effects/com_offset.toml", include_str!("../../effects/com_offset.toml")),
    ("effects/friction.toml", include_str!("../../effects/friction.toml")),
    ("effects/external_impulse.toml", include_str!("../../effects/external_impulse.toml")),
    ("effects/torsional_impulse.toml", include_str!("../../effects/torsional_impulse.toml")),
    ("effects/second_impact.toml", include_str!("../../effects/second_impact.toml")),
    ("effects/outlier.toml", include_str!("../../effects/outlier.toml")),
    ("effects/time_offset.toml", include_str!("../../effects/time_offset.toml")),
    ("effects/depth_scale.toml", include_str!("../../effects/depth_scale.toml")),
];

static CATALOGUE: LazyLock<Vec<Effect>> = LazyLock::new(|| {
    let read = |(file, text)| Effect::parse(text, file);
    // The texts are part of the program, and a test reads each.
    FILES.into_iter().map(read).collect::<Result<_>>().expect("the catalogue's files are good")
});

/// All effects that are built in.
pub fn catalogue() -> &'static [Effect] {
    &CATALOGUE
}

/// The effect of the catalogue with this name, or the one in the file at this path. What ends in
/// `.toml` or holds a `/` is a path.
///
/// # Errors
/// No effect has this name (with the likely one), or the file isn't good.
pub fn find(name_or_path: &str) -> Result<Cow<'static, Effect>> {
    if is_path(name_or_path) {
        return Effect::read(name_or_path).map(Cow::Owned);
    }
    if let Some(effect) = catalogue().iter().find(|effect| effect.name == name_or_path) {
        return Ok(Cow::Borrowed(effect));
    }
    let problem = format!("there is no effect {}", quoted(name_or_path));
    let names: Vec<&str> = catalogue().iter().map(|effect| effect.name.as_str()).collect();
    let files = [name_or_path.to_string(), format!("{name_or_path}.toml")];
    let mend = match files.iter().find(|file| Path::new(file).is_file()) {
        Some(file) => format!("to read the file of this name, write ./{file}"),
        None => did_you_mean(name_or_path, &names),
    };
    Err(Error::new(ErrorKind::Invalid, problem).mend(mend))
}

/// That an effect is the catalogue's, or has a name of its own.
pub(super) fn check_is_told_apart(effect: &Effect) -> Result<()> {
    if catalogue().iter().any(|known| known.name == effect.name && known != effect) {
        let problem = format!("is {}, which is the catalogue's", quoted(&effect.name));
        let mend = "give yours another name: answers tell effects by it";
        return Err(Error::invalid("name", problem).mend(mend));
    }
    Ok(())
}

pub(super) fn is_path(text: &str) -> bool {
    text == "-" || text.ends_with(".toml") || text.contains(['/', std::path::MAIN_SEPARATOR])
}

/// The effect of the catalogue with this name.
///
/// # Errors
/// There is none.
pub(crate) fn known(name: &str) -> Result<&'static Effect> {
    catalogue().iter().find(|effect| effect.name == name).ok_or_else(|| {
        let names: Vec<&str> = catalogue().iter().map(|effect| effect.name.as_str()).collect();
        let problem = format!("{} is no effect of the catalogue", quoted(name));
        Error::invalid("name", problem).mend(format!(
            "{}; an effect of your own stands in `definition`",
            did_you_mean(name, &names)
        ))
    })
}
