//! What laws compute, by hand.

use smash::effect::{Effect, Hook, INPUTS};

use super::with_acceleration;

/// x of the acceleration that `law`, in m/s², gives for v = (3, 4, 0), p = (1, 2, 3), k = 2.
fn x_of(law: &str) -> f64 {
    // A factor that is 0 at the null keeps the law a law; at k = 2 it is 1.
    let text = with_acceleration(&format!("(k / 2) * ({law})"), "1");
    let effect = Effect::parse(&text, "law.toml").unwrap_or_else(|error| panic!("{law}: {error}"));
    let mut known = vec![0.0; usize::from(INPUTS)];
    known[1..4].copy_from_slice(&[1.0, 2.0, 3.0]);
    known[4..7].copy_from_slice(&[3.0, 4.0, 0.0]);
    // A quarter turn about z: x to y.
    known[7..11].copy_from_slice(&[0.5_f64.sqrt(), 0.0, 0.0, 0.5_f64.sqrt()]);
    known[20..23].copy_from_slice(&[0.0, -10.0, 0.0]);
    known[32] = 5.0;
    known.push(2.0);
    let (hook, program) = &effect.laws[0];
    assert_eq!(*hook, Hook::Acceleration);
    program.evaluate(&known, 3)[0]
}

#[test]
fn laws_compute_what_they_say() {
    // `norm(g)` is 10 m/s²: it lends its unit to pure numbers.
    for (number, wanted) in [
        ("1 + 2 * 3", 7.0),
        ("(1 + 2) * 3", 9.0),
        ("8 / 4 / 2", 1.0),
        ("1 - 2 - 3", -4.0),
        ("2 ^ 3 ^ 2", 512.0),
        ("-2 ^ 2", -4.0),
        ("2 ^ -1", 0.5),
        ("- - 2 + +1", 3.0),
        (".5e1 + 1.5E-1", 5.15),
        ("min(3, 2) + max(3, 2) * 10", 32.0),
        ("clamp(7, 0, 2) + clamp(-1, 0, 2)", 2.0),
        ("step(-1) + 2 * step(0) + 4 * step(1)", 6.0),
        ("sign(-7) + 3 * sign(0) + 5 * sign(2)", 4.0),
        ("same(1, 1 + 1e-12) + 2 * same(1, 1.001)", 1.0),
        ("sqrt(16) + abs(-2) + pow(2, 3)", 14.0),
        ("exp(log(3)) + tanh(0)", 3.0),
        ("sin(pi / 2) + cos(pi) + tan(pi / 4)", 1.0),
        ("asin(1) + acos(1) + atan(1) - atan2(1, 1)", std::f64::consts::FRAC_PI_2),
        ("norm(p / p.x) ^ 2", 14.0),
        ("dot(p, p) / norm(p) ^ 1.5 / norm(p) ^ 0.5", 1.0),
        ("p.y / p.x * 3", 6.0),
        ("norm(g) * 2 / norm(g)", 2.0),
        ("cross(p, g).z * mass / (p.x * g.y * mass)", 1.0),
        ("rotate(p).x / p.x + 10 * unrotate(p).x / p.x", 18.0),
        ("unit(v).x * 5", 3.0),
        ("norm([1, 2, 2])", 3.0),
        ("norm(0 * p) / p.x", 0.0),
    ] {
        let found = x_of(&format!("({number}) * norm(g) * [0.1, 0, 0]"));
        assert!((found - wanted).abs() < 1e-12 * (1.0 + wanted.abs()), "{number}: {found}");
    }
}

#[test]
fn vectors_compute_component_by_component() {
    for (law, wanted) in [
        ("g.y * [1, 0, 0]", -10.0),
        ("(cross(v, up) - [1, 2, 3] * v.x) / p.x * v.x", -9.0),
        ("[g.y, 0, 0] + g", -10.0),
        ("-(g.y * unit(v))", 6.0),
        ("v / 2 * v.x / p.x", 4.5),
        ("rotate([0, -norm(g), 0])", 10.0),
    ] {
        let found = x_of(law);
        assert!((found - wanted).abs() < 1e-12, "{law}: {found}");
    }
}

/// No law pays twice for what it says twice.
#[test]
fn what_is_said_twice_is_computed_once() {
    let instructions = |law: &str| {
        let effect = Effect::parse(&with_acceleration(law, "1"), "law.toml").unwrap();
        effect.laws[0].1.instructions.len()
    };
    // A difference, a norm, a product, a quotient, a multiple of g.
    assert_eq!(instructions("k * norm(p - camera) / norm(p - camera) * g"), 5);
    assert_eq!(instructions("k * 2 * g / 2"), 4);
}
