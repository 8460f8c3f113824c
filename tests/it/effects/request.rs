//! Effects as a command line asks for them: `NAME[@BODY][:parameter=value,…]`.

use std::fs;

use smash::effect::EffectRequest;

use super::with_acceleration;

fn message(text: &str) -> String {
    EffectRequest::parse(text).unwrap_err().to_string()
}

#[test]
fn names_bodies_and_values_are_read() {
    let plain = EffectRequest::parse("quadratic_drag").unwrap();
    assert_eq!((plain.effect.name.as_str(), plain.body), ("quadratic_drag", None));
    assert!(plain.fixed.is_empty());

    let full = EffectRequest::parse("quadratic_drag@ball 1:k=0.15").unwrap();
    assert_eq!(full.body.as_deref(), Some("ball 1"));
    assert_eq!(full.fixed["k"], [0.15]);

    let vectors = EffectRequest::parse("second_impact@a:time=0.25,impulse=[1, -2,3e-1]").unwrap();
    assert_eq!(vectors.fixed["time"], [0.25]);
    assert_eq!(vectors.fixed["impulse"], [1.0, -2.0, 0.3]);
    assert_eq!(vectors.fixed.len(), 2);

    let everywhere = EffectRequest::parse("gravity_scale:s=0.98").unwrap();
    assert_eq!((everywhere.body, everywhere.fixed["s"].as_slice()), (None, &[0.98][..]));
}

/// A folder may be called as it likes.
#[test]
fn a_path_may_hold_what_separates() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("me@home:8.toml.d");
    fs::create_dir(&inner).unwrap();
    let path = inner.join("wind.toml");
    fs::write(&path, with_acceleration("k * up", "m/s^2")).unwrap();
    let path = path.to_str().unwrap();
    assert_eq!(EffectRequest::parse(path).unwrap().effect.name, "mine");
    let full = EffectRequest::parse(&format!("{path}@a:k=2")).unwrap();
    assert_eq!((full.body.as_deref(), full.fixed["k"].as_slice()), (Some("a"), &[2.0][..]));
}

#[test]
fn what_cant_be_meant_is_refused_with_the_mend() {
    for (text, parts) in [
        ("", ["name is missing", "NAME[@BODY]"]),
        ("@a", ["name is missing", "NAME[@BODY]"]),
        ("magnus@", ["body's name is missing", "after `@`"]),
        ("magnsu@a", ["no effect `magnsu`", "did you mean `magnus`?"]),
        ("inertia:facto=[1,1,1]", ["no parameter `facto`", "did you mean `factor`?"]),
        ("magnus:k", ["`k` sets nothing", "parameter=value"]),
        ("magnus:", ["sets nothing", "parameter=value"]),
        ("magnus:k=", ["magnus:k: `` is no value of it", "one number, in 1"]),
        ("magnus:k=[1,2,3]", ["magnus:k: `[1,2,3]` is no value", "one number"]),
        ("magnus:k=0.1,k=0.2", ["`k` is set twice", "keep one"]),
        ("magnus:k=7", ["7 is outside its bounds", "-1 to 1"]),
        ("magnus:k=NaN", ["NaN is outside its bounds", "-1 to 1"]),
        ("constant_force:a=1", ["constant_force:a: `1` is no value", "[x,y,z]"]),
        ("constant_force:a=[1,2]", ["`[1,2]` is no value", "in m/s^2"]),
        ("constant_force:a=[1,2,inf]", ["inf is outside its bounds", "-100 to 100 m/s^2"]),
    ] {
        let message = message(text);
        for part in parts {
            assert!(message.contains(part), "{text}: no {part:?} in {message}");
        }
    }
}
