//! What is wrong in an effect file is said with the field, a caret and a mend.

use std::fs;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use smash::effect::{Effect, Need};

use super::{effect, with_acceleration};

fn message(text: &str) -> String {
    Effect::parse(text, "law.toml").unwrap_err().to_string()
}

/// The message for an `acceleration` with the parameter k in 1/s, without the file and field.
fn of_law(law: &str) -> String {
    let message = message(&with_acceleration(law, "1/s"));
    let rest = message.strip_prefix("law.toml: law.acceleration: ");
    rest.unwrap_or_else(|| panic!("{law}: {message}")).to_owned()
}

#[test]
fn a_mistake_in_a_law_has_a_caret_and_a_mend() {
    for (law, lines) in [
        ("-k * vv", ["`vv` is unknown", "     ^^", "known here: `k`, `t`, `p`, `v`"]),
        ("-k * norn(v) * v", ["`norn` is no function", "     ^^^^", "did you mean `norm`?"]),
        (
            "-k * v * J.x",
            ["`J` isn't known in `acceleration`", "         ^", "known here: k t p v"],
        ),
        ("-k * norm", ["`norm` is a function", "     ^^^^", "write norm(…)"]),
        ("-k * p", ["must be in m/s^2, and this is in m/s", "^^^^^^", "unit of `k` is 1/s^2"]),
        ("-k * norm(v)", ["must be a vector, and this is a number", "^^^^", "direction"]),
        ("-k * v * v", ["two vectors have two products", "^^^^", "dot(a, b) or cross(a, b)"]),
        ("-k * v + 1", ["a vector and a number can't be added", "^^^^", "direction"]),
        ("-k * (v + p)", ["m/s and m don't go together", "     ^^^^^^^", "the same unit"]),
        ("-k * max(norm(v), 2) * up", ["m/s and 1 don't go", "     ^^^^", "make it a parameter"]),
        ("-k * exp(norm(v)) * v", ["a pure number must stand", "         ^^^^^^^", "divide it"]),
        ("-k * (v", ["this bracket is never closed by `)`", "     ^", "write `)`"]),
        ("-k * norm(v * v", ["this bracket is never closed by `)`", "         ^", "write `)`"]),
        ("-k * [v.x, 0, 0)", ["`)` where `]` should stand", "               ^", "write `]`"]),
        ("-k * v)", ["`)` closes nothing", "      ^", "take it out"]),
        ("-k v", ["two values stand side by side", "   ^", "write `*`"]),
        ("-2k * v", ["two values stand side by side", "  ^", "write `*`"]),
        ("k(v)", ["`k` is no function", "^", "write `*` before the bracket"]),
        ("-k * ", ["ends where a value is missing", "", "write the value"]),
        ("k * * v", ["a value is missing before `*`", "    ^", "write it"]),
        ("", ["is empty", "^", "write an expression"]),
        ("-k * v ** 2", ["`**` has no meaning here", "       ^^", "write `^`"]),
        ("-k * |v| * v", ["`|` has no meaning here", "     ^", "norm(v)"]),
        ("−k * v", ["`−` has no meaning here", "^", "write `-`"]),
        ("-k * v²", ["`²` has no meaning here", "      ^", "write `^2`"]),
        ("a = -k * v", ["`=` has no meaning here", "  ^", "without its name"]),
        ("-k * v.w * up", ["no component `w`", "     ^^^", ".x, .y or .z"]),
        ("-k * k.x * v", ["a number has no components", "     ^^^", "of a vector"]),
        ("-k * abs(v) * v", ["`abs` takes a number", "         ^", "norm(v)"]),
        ("-k * norm(k) * v", ["`norm` takes a vector", "          ^", "abs(x)"]),
        ("-k * dot(v) * v", ["`dot` takes 2 arguments, not 1", "     ^^^^^^", "2 arguments"]),
        ("-k * [v.x, v.y]", ["3 components, not 2", "     ^^^^^", "[x, y, z]"]),
        ("-k * v / v", ["nothing can be divided by a vector", "         ^", "norm(…)"]),
        ("-k * q * v", ["`q` can't be reckoned with", "     ^", "rotate(v)"]),
        ("-k * v ^ 2", ["a vector has no place in a power", "     ^", "norm(v)^2"]),
        ("-k * norm(v) ^ k * up", ["pure number must stand", "               ^", "divide it"]),
        ("-k * 1e999 * v", ["`1e999` is no number", "     ^^^^^", "1.5e-3"]),
        ("-k * 1.2.3 * v", ["`1.2.3` is no number", "     ^^^^^", "0.15"]),
    ] {
        let message = of_law(law);
        let [problem, caret, mend] = lines;
        let found: Vec<&str> = message.lines().collect();
        assert_eq!(found.len(), 4, "{law}: {message}");
        assert!(found[0].contains(problem), "{law}: {message}");
        assert_eq!(found[1].trim(), law.trim(), "{message}");
        assert!(found[2].starts_with(&format!("    {caret}")), "{law}: {message}");
        assert!(found[3].starts_with("  hint: ") && found[3].contains(mend), "{law}: {message}");
    }
}

#[test]
fn each_hook_has_its_own_names_type_and_unit() {
    let law =
        |line: &str| effect(&format!("[parameters.k]\nunit = \"1\"\nnull = 0\n[law]\n{line}"));
    for (line, problem) in [
        ("inertia = \"[1, 1, 1] + k * v\"", "`v` isn't known in `inertia`"),
        ("time = \"t + k * [t, 0, 0]\"", "a number and a vector can't be added"),
        ("time = \"t + k\"", "s and 1 don't go together"),
        ("time = \"rotate([t, 0, 0]).x + k * t\"", "the orientation isn't known in `time`"),
        ("position = \"p + k * t * v\"", "`v` isn't known in `position`"),
        ("torque = \"k * v\"", "`torque` must be in m^2/s^2, and this is in m/s"),
        ("impulse = \"k * g\"", "`impulse` must be in m/s, and this is in m/s^2"),
        ("impulse_point = \"k * x\"", "has no impulse that acts there"),
        ("event_time = \"k * t_c\"", "has nothing that happens then"),
        ("event_impulse = \"k * v\"", "law.event_time: is missing"),
        ("", "law: is empty"),
    ] {
        let message = message(&law(line));
        assert!(message.contains(problem), "{line}: {message}");
    }
    let contact = format!("scope = \"contact\"\n{}", law("torque = \"k * L * norm(w)\""));
    assert!(message(&contact).contains("law.torque: acts on a body, not on a contact"));
}

#[test]
fn a_parameter_must_make_sense() {
    let parameter = |name: &str, lines: &str| {
        effect(&format!(
            "[parameters.{name}]\n{lines}\n[law]\nacceleration = \"-{} * v\"",
            name.trim_matches('"')
        ))
    };
    for (name, lines, parts) in [
        ("k", "unit = \"1/s\"\nnull = -1\nbounds = [0, 1]", ["k.null: -1 is outside", "0 to 1"]),
        ("k", "unit = \"1/s\"\nnull = 0\nbounds = [1, 0]", ["k.bounds: 1 isn't below 0", "least"]),
        ("k", "unit = \"1/s\"\nnull = 0\nscale = 0", ["k.scale: 0 isn't above 0", "typical size"]),
        (
            "k",
            "unit = \"1/ms\"\nnull = 0",
            ["k.unit: `ms` is no unit\n    1/ms\n      ^^", "in `s`"],
        ),
        ("k", "unit = \"1/s +\"\nnull = 0", ["k.unit: ends where a value is missing", "sign"]),
        ("k", "unit = \"\"\nnull = 0", ["k.unit: is empty", "write `1`"]),
        ("k", "unit = \"2/s\"\nnull = 0", ["k.unit: is no unit\n    2/s\n    ^", "m/s^2"]),
        ("k", "unit = \"1/s\"", ["parameters.k: the field `null` is missing", "add `null`"]),
        ("k", "unit = \"1/s\"\nnull = [0, 0]", ["parameters.k.null", "three"]),
        ("k", "unit = \"1/s\"\nnull = nan", ["line 4, column 8: a number isn't finite", "finite"]),
        ("k", "unit = \"1/s\"\nnull = 0\nbound = [0, 1]", ["k.bound: is an unknown", "`bounds`"]),
        ("k", "unit = \"1/s\"\nnull = 0\nscan = \"gap\"", ["is \"gap\", which is", "`gaps`"]),
        ("k", "unit = \"1/s\"\nnull = 0\nframe = \"body\"", ["k.frame: only a vector", "out"]),
        ("v", "unit = \"1\"\nnull = 0", ["`v` means something else", "another name"]),
        ("norm", "unit = \"1\"\nnull = 0", ["`norm` means something else", "another name"]),
        ("pi", "unit = \"1\"\nnull = 0", ["`pi` means something else", "another name"]),
        ("\"a b\"", "unit = \"1\"\nnull = 0", ["parameters: `a b` can't be a name", "letters"]),
        ("k", "unit = \"1/s\"\nnull = 1", ["law.acceleration: does something at the null", "null"]),
    ] {
        let message = message(&parameter(name, lines));
        for part in parts {
            assert!(message.contains(part), "{name} {lines}: no {part:?} in {message}");
        }
    }
    let idle = with_acceleration("-k * v", "1/s") + "[parameters.n]\nunit = \"1\"\nnull = 0";
    assert!(message(&idle).contains("parameters.n: isn't used by any law"));
}

#[test]
fn the_file_itself_must_make_sense() {
    let good = with_acceleration("-k * v", "1/s");
    let twice = good.replace("[law]", "[parameters.k]\nunit = \"1\"\nnull = 0\n[law]");
    for (text, parts) in [
        ("".into(), ["law.toml: is empty", "was it saved?"]),
        ("# nothing\n".into(), ["the field `name` is missing", "add `name`"]),
        (good.replace("mine", "no name"), ["name: `no name` can't be a name", "letters"]),
        (format!("titel = \"x\"\n{good}"), ["titel: is an unknown field", "`title`"]),
        (format!("scope = \"boddy\"\n{good}"), ["scope: is \"boddy\"", "`body`"]),
        (format!("needs = [\"camra\"]\n{good}"), ["needs[0]", "`camera`"]),
        (format!("name = \"again\"\n{good}"), ["line 2, column 1: the same key again", "one of"]),
        (twice, ["the same key again, at `[parameters.k]`", "keep one"]),
        (good.replace("acceleration", "accelration"), ["law.accelration", "`acceleration`"]),
        (good.replace("\"-k * v\"", "-k * v"), ["isn't TOML", "between quotes"]),
        (good.replace("[law]", "[law"), ["isn't TOML", "[law"]),
        (good.replace("[parameters.k]", "[parameters]\n[other.k]"), ["other", "unknown field"]),
        (good.replace("\"-k * v\"", "3"), ["law.acceleration: is 3", "text"]),
    ] {
        let message = message(&text);
        for part in parts {
            assert!(message.contains(part), "{text}\nno {part:?} in {message}");
        }
    }
}

/// Who forgets what a law needs isn't told nonsense by a scene that lacks it.
#[test]
fn names_imply_what_a_scene_must_have() {
    for (law, needs) in [
        ("k * v", &[][..]),
        ("k * (p - camera) * norm(w)", &[Need::Camera, Need::Orientation]),
        ("k * dot(v, normal) * normal", &[Need::Plane]),
        ("k * rotate(v)", &[Need::Orientation]),
    ] {
        assert_eq!(
            Effect::parse(&with_acceleration(law, "1/s"), "").unwrap().needs,
            needs,
            "{law}"
        );
    }
    let contact = "[parameters.k]\nunit = \"1\"\nnull = 0\n[law]\nimpulse = \"k * ";
    for (law, needs) in [("dot(J, normal) * normal", &[][..]), ("slip", &[Need::Plane])] {
        let text = effect(&format!("{contact}{law}\""));
        assert_eq!(Effect::parse(&text, "").unwrap().needs, needs, "{law}");
    }
}

/// At rest, and without spin, v / norm(v) isn't a number.
#[test]
fn a_law_must_be_finite_wherever_bodies_may_be() {
    for (law, unit, state) in [
        ("-k * v / norm(v)", "m/s^2", "at rest"),
        ("k * log(norm(w) / norm(w)) * up", "m/s^2", "without spin"),
        ("k * v / norm(v) ^ 3", "m^3/s^4", "at rest"),
    ] {
        let message = message(&with_acceleration(law, unit));
        assert!(message.contains("law.acceleration: isn't finite "), "{law}: {message}");
        assert!(message.contains(state) || message.contains("at rest"), "{law}: {message}");
        assert!(message.contains("unit(v), which is 0 at 0"), "{law}: {message}");
    }
    Effect::parse(&with_acceleration("-k * unit(v)", "m/s^2"), "law.toml").unwrap();
}

/// Whatever stands in a file, there is an answer: no overflow of the stack, no endless work.
#[test]
fn hostile_files_are_refused_with_words() {
    let nested =
        |open: &str, close: &str| of_law(&format!("{}v{}", open.repeat(200), close.repeat(200)));
    for message in [nested("(", ")"), nested("-", ""), nested("norm(", ")"), nested("2^", "")] {
        assert!(message.starts_with("is nested deeper than 64 levels"), "{message}");
        assert!(message.lines().all(|line| line.chars().count() < 90), "{message}");
    }
    let long = of_law(&vec!["v"; 501].join(" + "));
    assert!(long.starts_with("is longer than 1000 words and signs"), "{long}");
    // Long, but within the limits: the depth of the tree is that of the sum.
    let sum = vec!["v"; 490].join(" + ");
    Effect::parse(&with_acceleration(&format!("k * ({sum})"), "1/s"), "law.toml").unwrap();

    let huge = format!("# {}\n", "x".repeat(100_000));
    assert!(message(&huge).contains("is larger than 64 KiB"), "{}", message(&huge));
    let deep = format!("name = {}1{}", "[".repeat(10_000), "]".repeat(10_000));
    assert!(message(&deep).contains("isn't TOML"), "{}", message(&deep));
    let many = (0..40).map(|n| format!("[parameters.k{n}]\nunit = \"1\"\nnull = 0\n"));
    let many = effect(&format!("{}[law]\ntime = \"t\"", many.collect::<String>()));
    assert!(message(&many).contains("1 to 32 parameters, not 40"), "{}", message(&many));
}

#[test]
fn a_file_that_is_no_text_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("law.toml");
    fs::write(&path, b"name = \"\xff\"").unwrap();
    let message = Effect::read(&path).unwrap_err().to_string();
    assert!(message.contains("byte 8 isn't UTF-8 text"), "{message}");
    fs::write(&path, vec![b'#'; 100_000]).unwrap();
    let message = Effect::read(&path).unwrap_err().to_string();
    assert!(message.contains("larger than 64 KiB") && message.contains("a page"), "{message}");
}

/// Broken copies of good laws, with letters of all lengths: an answer, never a panic.
#[test]
fn no_text_is_too_strange() {
    const LETTERS: [char; 22] = [
        'k', 'v', 'p', '.', ',', '(', ')', '[', ']', '+', '-', '*', '/', '^', ' ', '0', '9', 'e',
        '²', '−', '😀', '\t',
    ];
    let mut random = ChaCha8Rng::seed_from_u64(11);
    let mut refused = 0;
    for law in ["-k * norm(v) * v", "k * [v.x, 0, -v.y ^ 2 / v.x]", "rotate(k * (p + v * 1e-3))"] {
        for _ in 0..500 {
            let mut letters: Vec<char> = law.chars().collect();
            for _ in 0..random.random_range(1..6) {
                let at = random.random_range(0..letters.len());
                letters[at] = LETTERS[random.random_range(0..LETTERS.len())];
            }
            let law: String = letters.into_iter().collect();
            for text in [with_acceleration(&law, "1/m"), with_acceleration("k * v", &law)] {
                refused += usize::from(Effect::parse(&text, "law.toml").is_err());
            }
        }
    }
    assert!(refused > 2000, "only {refused} of 3000 broken files were refused");
}
