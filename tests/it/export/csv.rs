//! The table: its numbers obey the mechanics that they stand for.

use smash::export;
use smash::nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{Row, SCENES, result, rows, scene, track};

const SIDES: [&str; 2] = ["before", "after"];

fn quaternion(row: &Row) -> UnitQuaternion<f64> {
    let [w, x, y, z] = row.orientation.unwrap();
    UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z))
}

/// Frames are the film's; besides them there are the collision, on both sides, and both ends.
#[test]
fn rows_stand_at_the_frames_and_at_the_collision() {
    for name in SCENES {
        let (result, scene) = (result(name), scene(name));
        let collision_s = result.collision_time.value.unwrap();
        let first_s = scene.bodies().iter().map(|b| b.observations[0].time_s);
        let first_s = first_s.fold(f64::INFINITY, f64::min);
        for fps in [7.0, 60.0, 250.0] {
            let rows = rows(&export::csv(&result, Some(fps)).unwrap());
            for body in scene.bodies() {
                let [before, after] = SIDES.map(|side| track(&rows, &body.name, side));
                assert_eq!(before.last().unwrap().time_s, collision_s);
                assert_eq!(after[0].time_s, collision_s);
                assert_eq!(before[0].time_s, body.observations[0].time_s);
                assert_eq!(after.last().unwrap().time_s, body.observations.last().unwrap().time_s);
                for track in [&before, &after] {
                    assert!(track.windows(2).all(|pair| pair[0].time_s < pair[1].time_s));
                    for row in &track[1..track.len() - 1] {
                        let frame = (row.time_s - first_s) * fps;
                        assert!((frame - frame.round()).abs() < 1e-6, "{name}: {}", row.time_s);
                    }
                    let steps = track.windows(2).map(|pair| pair[1].time_s - pair[0].time_s);
                    assert!(steps.fold(0.0, f64::max) < (1.0 + 1e-6) / fps, "{name}");
                }
            }
        }
    }
}

/// Without effects a flight is a parabola about the collision, in closed form: only rounding is left.
#[test]
fn positions_and_velocities_lie_on_the_parabola() {
    for name in SCENES {
        let result = result(name);
        let gravity = Vector3::from(result.gravity.unwrap());
        let collision_s = result.collision_time.value.unwrap();
        let rows = rows(&export::csv(&result, None).unwrap());
        for body in &result.bodies {
            for (side, velocity) in
                SIDES.into_iter().zip([body.velocity_before, body.velocity_after])
            {
                let velocity = Vector3::from(velocity);
                for row in track(&rows, &body.name, side) {
                    let since_s = row.time_s - collision_s;
                    let expected = Vector3::from(body.position)
                        + (velocity + gravity * since_s / 2.0) * since_s;
                    assert!((Vector3::from(row.position) - expected).norm() < 1e-12, "{name}");
                    let expected = velocity + gravity * since_s;
                    assert!((Vector3::from(row.velocity) - expected).norm() < 1e-12, "{name}");
                }
            }
        }
    }
}

/// Quaternions have length 1 and no jumps of sign; and they turn by the spin beside them: over 1/2000 s
/// its change counts for a few parts in a thousand.
#[test]
fn orientations_turn_by_the_spin() {
    for name in ["boxes", "uneven_times", "box_on_floor"] {
        let result = result(name);
        let rows = rows(&export::csv(&result, Some(2000.0)).unwrap());
        for body in &result.bodies {
            let [before, after] = SIDES.map(|side| track(&rows, &body.name, side));
            let (last, first) = (before.last().unwrap(), &after[0]);
            assert!(quaternion(last).coords.dot(&quaternion(first).coords) > 1.0 - 1e-9);
            for pair in [before, after].iter().flat_map(|track| track.windows(2)) {
                let [from, to] = pair else { panic!("two rows") };
                assert!((quaternion(from).norm() - 1.0).abs() < 1e-12);
                assert!(quaternion(from).coords.dot(&quaternion(to).coords) > 0.99);
                let step_s = to.time_s - from.time_s;
                let turned = (quaternion(to) * quaternion(from).inverse()).scaled_axis();
                let spin = Vector3::from(from.spin.unwrap());
                assert!((turned - spin * step_s).norm() < 5e-3 * spin.norm() * step_s + 1e-9);
            }
        }
    }
}

/// The table's own numbers keep the books: the momentum of both bodies is the same on both sides of the
/// collision, and so is each pose. The track before ends a rounding before the collision.
#[test]
fn momentum_is_the_same_on_both_sides() {
    for name in ["boxes", "uneven_times"] {
        let result = result(name);
        let mass_ratio = result.mass_ratio.as_ref().unwrap().value.unwrap();
        let rows = rows(&export::csv(&result, None).unwrap());
        let at_collision = |body: &str| {
            let [before, after] = SIDES.map(|side| track(&rows, body, side));
            (before.last().unwrap().clone(), after[0].clone())
        };
        let bodies = ["a", "b"].map(at_collision);
        let momentum = |of: fn(&(Row, Row)) -> &Row| {
            let [a, b] = bodies.each_ref().map(|body| Vector3::from(of(body).velocity));
            a + mass_ratio * b
        };
        assert!((momentum(|body| &body.0) - momentum(|body| &body.1)).norm() < 1e-9);
        for (before, after) in &bodies {
            let apart = Vector3::from(before.position) - Vector3::from(after.position);
            assert!(apart.norm() < 1e-12);
            assert!(quaternion(before).angle_to(&quaternion(after)) < 1e-7);
        }
    }
}

/// A ball without marks has neither orientation nor spin: empty cells.
#[test]
fn what_is_not_known_is_empty() {
    let table = export::csv(&result("ball_on_floor"), None).unwrap();
    let rows = rows(&table);
    assert!(rows.iter().all(|row| row.orientation.is_none() && row.spin.is_none()));
    assert!(table.lines().nth(1).unwrap().contains(",,,,"));
    assert!(!table.contains("NaN"));
}

/// Effects act: with a drag the ball's energy falls all the time.
#[test]
fn effects_act_on_the_way() {
    let scene = scene("thrown_ball_drag");
    let options = smash::reconstruct::RefinedOptions {
        effects: vec![smash::effect::EffectRequest::parse("quadratic_drag@ball").unwrap()],
        ..Default::default()
    };
    let result = smash::reconstruct(&scene, &smash::Options::Refined(options)).unwrap();
    let rows = rows(&export::csv(&result, None).unwrap());
    let energy =
        |row: &Row| Vector3::from(row.velocity).norm_squared() / 2.0 + 9.81 * row.position[1];
    assert!(rows.len() > 90);
    assert!(rows.windows(2).all(|pair| energy(&pair[1]) < energy(&pair[0])));
}

/// Time stamps of Unix clocks leave a microsecond between neighbours; the collision is told all the
/// same, once on each side.
#[test]
fn late_time_stamps_are_no_matter() {
    let text = std::fs::read_to_string(format!("{}/scenes/boxes.json", env!("CARGO_MANIFEST_DIR")));
    let late = crate::scenes::edited(serde_json::from_str(&text.unwrap()).unwrap(), |scene| {
        for body in scene["bodies"].as_array_mut().unwrap() {
            for seen in body["observations"].as_array_mut().unwrap() {
                let time = 1.7e9 + seen["frame"].as_f64().unwrap() / 60.0;
                seen.as_object_mut().unwrap().remove("frame");
                seen["time"] = time.into();
            }
        }
    });
    let late = smash::Scene::parse(&late.to_string(), "late.json").unwrap();
    let late = smash::reconstruct(&late, &smash::Options::default()).unwrap();
    let rows = rows(&export::csv(&late, None).unwrap());
    for body in ["a", "b"] {
        let [before, after] = SIDES.map(|side| track(&rows, body, side));
        assert_eq!(before.last().unwrap().time_s, after[0].time_s);
        assert!(after[0].time_s < after[1].time_s);
        let apart =
            Vector3::from(before.last().unwrap().position) - Vector3::from(after[0].position);
        assert!(apart.norm() < 1e-6);
    }
}

/// A spreadsheet computes what starts so: from a stranger's result it would be a stranger's formula.
#[test]
fn a_name_that_would_be_computed_stays_a_text() {
    for (name, cell) in [
        ("=1+1", "'=1+1"),
        ("+a", "'+a"),
        ("-a", "'-a"),
        ("@a", "'@a"),
        ("a=1", "a=1"),
        ("=\"a\",1", "\"'=\"\"a\"\",1\""),
    ] {
        let mut result = result("ball_on_floor");
        result.bodies[0].name = name.to_string();
        result.setting.as_mut().unwrap().bodies[0].name = name.to_string();
        let table = export::csv(&result, Some(60.0)).unwrap();
        for line in table.lines().skip(1) {
            let (_, rest) = line.split_once(',').unwrap();
            assert!(
                rest.starts_with(&format!("{cell},before,"))
                    || rest.starts_with(&format!("{cell},after,")),
                "{line}"
            );
        }
    }
}
