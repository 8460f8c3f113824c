//! Tables of poses to scenes.

use std::process::Command;

use smash::import::{ImportOptions, LengthUnit, QuaternionOrder, Table, import_csv};
use smash::scene::{SceneFile, Shape};
use smash::{Result, Scene};

fn options() -> ImportOptions {
    ImportOptions {
        name: "table".into(),
        length_unit: LengthUnit::Centimetre,
        quaternion: None,
        fps: Some(50.0),
        up: [0.0, 0.0, 1.0],
        gravity_m_s2: 9.81,
        shapes: vec![("a".into(), Shape::Sphere { radius: 5.0 })],
        plane: Some(([0.0, 0.0, 1.0], 10.0)),
    }
}

fn import(text: &str, options: &ImportOptions) -> Result<SceneFile> {
    import_csv(&[Table { file: "poses.csv", text }], options).map(|import| import.scene_file)
}

/// Lengths of a table in cm become m: positions, shapes and the plane.
#[test]
fn one_body_in_centimetres() {
    let text = "frame,x,y,z,qw,qx,qy,qz\n0,1,2,30,1,0,0,0\n1,1,2,20,,,,\n2,1,2,20,0,1,0,0\n3,1,2,30,1,0,0,0\n";
    let file = import(text, &options()).unwrap();
    let scene = Scene::from_file(file).unwrap();
    let ball = &scene.bodies()[0];
    assert_eq!(ball.name, "a");
    assert_eq!(ball.shape, Shape::Sphere { radius: 0.05 });
    assert_eq!(ball.observations[1].time_s, 0.02);
    assert_eq!(ball.observations[1].world_from_body, None);
    // 20 × 0.01 rounds once.
    assert!((ball.observations[1].position_in_world.z - 0.2).abs() < 1e-15);
    assert_eq!(scene.plane().unwrap().height_m, 0.1);
}

/// The same poses as rows of bodies, as columns of bodies, and as a file for each body.
#[test]
fn three_layouts_give_the_same_scene() {
    let shapes = ["a", "b"].map(|name| (name.to_owned(), Shape::Sphere { radius: 5.0 })).to_vec();
    let options = ImportOptions { shapes, plane: None, ..options() };
    let long = "time,body,x,y,z\n0,a,1,2,3\n0,b,4,5,6\n0.1,a,1,2,4\n0.1,b,4,5,7\n0.2,a,1,2,5\n";
    let wide = "time,a_x,a_y,a_z,b_x,b_y,b_z\n0,1,2,3,4,5,6\n0.1,1,2,4,4,5,7\n0.2,1,2,5,,,\n";
    let a = Table { file: "folder/a.csv", text: "time,x,y,z\n0,1,2,3\n0.1,1,2,4\n0.2,1,2,5\n" };
    let b = Table { file: "folder/b.csv", text: "Time , X, Y, Z\r\n0,4,5,6\r\n0.1,4,5,7\r\n" };
    let from_long = import(long, &options).unwrap();
    assert_eq!(import(wide, &options).unwrap(), from_long);
    assert_eq!(import_csv(&[a, b], &options).unwrap().scene_file, from_long);
    assert_eq!(from_long.bodies[1].observations.as_ref().unwrap().len(), 2);
}

#[test]
fn unnamed_quaternions_take_the_stated_order() {
    let text = "time,x,y,z,q0,q1,q2,q3\n0,0,0,0,0.1,0.2,0.3,0.4\n";
    let orientation = |order| {
        let file = import(text, &ImportOptions { quaternion: Some(order), ..options() }).unwrap();
        file.bodies[0].observations.as_ref().unwrap()[0].orientation
    };
    assert_eq!(orientation(QuaternionOrder::Wxyz), Some([0.1, 0.2, 0.3, 0.4]));
    assert_eq!(orientation(QuaternionOrder::Xyzw), Some([0.4, 0.1, 0.2, 0.3]));
}

#[test]
fn what_a_table_does_not_say_is_asked_for() {
    let cases = [
        ("time,x,y,z,q0,q1,q2,q3\n0,0,0,0,1,0,0,0\n", "header", "--quaternion wxyz"),
        ("x,y,z\n0,0,0\n", "header", "neither `frame` nor `time`"),
        ("frame,time,x,y,z\n0,0,0,0,0\n", "header", "both `frame` and `time`"),
        ("time,x,y\n0,0,0\n", "header", "lacks coordinates"),
        ("time,x,y,z,qw,qx\n0,0,0,0,1,0\n", "header", "incomplete quaternion"),
        ("time,x,y,z,bdoy\n0,0,0,0,a\n", "header", "did you mean `body`?"),
        ("time,x,y,z,x\n0,0,0,0,0\n", "header", "`x` twice"),
        ("time,x,y,z,a_x,a_y,a_z\n0,0,0,0,0,0,0\n", "header", "in two ways"),
        ("time;x;y;z\n0;0;0;0\n", "header", "commas between the columns"),
        ("time,x,y,z\n0,0,0,0\n1,0,zero,0\n", "line 3, column `y`", "`zero` is no finite number"),
        ("time,x,y,z\n0,0,0,NaN\n", "line 2, column `z`", "leave empty what wasn't measured"),
        ("time,x,y,z\n0,0,,0\n", "line 2, column `y`", "is empty"),
        ("time,x,y,z\n,0,0,0\n", "line 2, column `time`", "each pose needs its time"),
        ("time,x,y,z\n0,0,0\n", "line 2", "has 3 cells, but the header has 4"),
        ("time,x,y,z\r\n0,0,0,0\r\n1,0,zero,0\r\n", "line 3, column `y`", "`zero`"),
        ("time,x,y,z\r0,0,0,0\r1,0,zero,0\r", "line 3, column `y`", "`zero`"),
        ("time,x,y,z\n\n\n0,0,zero,0\n", "line 4, column `y`", "`zero`"),
        ("time,x,y,z\r\n\r\n0,0,0\r\n", "line 3", "has 3 cells"),
    ];
    for (text, place, words) in cases {
        let error = import(text, &options()).unwrap_err();
        assert_eq!(error.place(), Some(place), "{error}");
        assert!(error.to_string().contains(words) && error.hint().is_some(), "{error}");
        assert!(error.to_string().starts_with("poses.csv: "), "{error}");
    }
    let no_fps = ImportOptions { fps: None, ..options() };
    let error = import("frame,x,y,z\n0,0,0,0\n", &no_fps).unwrap_err();
    assert!(error.to_string().contains("--fps 60"), "{error}");
}

#[test]
fn bodies_and_shapes_must_match() {
    let text = "time,body,x,y,z\n0,a,0,0,0\n0,b,0,0,0\n";
    let error = import(text, &options()).unwrap_err();
    assert!(error.to_string().contains("--box b=SX,SY,SZ"), "{error}");
    let shapes = vec![("c".into(), Shape::Sphere { radius: 1.0 })];
    let error = import(text, &ImportOptions { shapes, ..options() }).unwrap_err();
    assert!(error.to_string().contains("known here: `a`, `b`"), "{error}");
}

#[test]
fn the_command_writes_a_scene_that_reads() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("ball.csv");
    std::fs::write(
        &table,
        "time,x,y,z\n0,0,0,0.3\n0.1,0,0,0.2\n0.2,0,0,0.1\n0.3,0,0,0.2\n0.4,0,0,0.3\n0.5,0,0,0.4\n",
    )
    .unwrap();
    let scene = folder.path().join("scene.json");
    let smash = |more: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
        command.arg("import").arg(&table).arg("-o").arg(&scene).args(more);
        command.output().unwrap()
    };
    // The unit and up are never guessed: leaving them out is wrong usage.
    assert_eq!(smash(&["--sphere", "ball=0.1"]).status.code(), Some(2));
    let done = smash(&[
        "--length-unit",
        "m",
        "--up",
        "z",
        "--sphere",
        "ball=0.1",
        "--floor",
        "0",
        "--json",
    ]);
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    let summary: serde_json::Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(summary["bodies"][0]["observations"], 6);
    let scene = Scene::read(&scene).unwrap();
    assert_eq!(scene.bodies()[0].name, "ball");
    assert_eq!(scene.plane().unwrap().name, "floor");
}

#[test]
fn a_table_without_rows_is_called_so() {
    for text in ["", " \r\n", "time,x,y,z", "time,x,y,z\r\n", "time,x,y,z\n0,,,\n"] {
        let error = import(text, &options()).unwrap_err();
        assert!(error.to_string().starts_with("poses.csv: has no rows"), "{text:?}: {error}");
    }
}

/// A name in each row, or a pose in each column: the third body ends it, not hours of comparing.
#[test]
fn the_third_body_is_one_too_many() {
    let rows: String = (0..300_000).map(|row| format!("0,body{row},0,0,0\n")).collect();
    let error = import(&format!("time,body,x,y,z\n{rows}"), &options()).unwrap_err();
    assert_eq!(error.to_string().split(": ").nth(1), Some("line 4"), "{error}");
    assert!(error.problem().contains("`body2` is one body too many"), "{error}");
    let columns: String = (0..300_000).map(|column| format!(",b{column}_x")).collect();
    let error = import(&format!("time{columns}\n"), &options()).unwrap_err();
    assert!(error.problem().contains("300001 columns"), "{error}");
}

/// Rules of the scene name what the user wrote: a line of the table, or an option.
#[test]
fn rules_of_the_scene_point_to_the_table_or_the_option() {
    let text = "time,x,y,z,qw,qx,qy,qz\r\n0,0,0,1,1,0,0,0\r\n1,0,0,1,1,0,0,0\r\n2,0,0,1,1,0,0,0\r\n3,0,0,1,1,0,0,0\r\n";
    let good = ImportOptions { length_unit: LengthUnit::Metre, ..options() };
    let refused = |text: &str, options: &ImportOptions| {
        let import = import_csv(&[Table { file: "poses.csv", text }], options).unwrap();
        import.check().unwrap_err().to_string()
    };
    let ball = |radius| vec![("a".to_owned(), Shape::Sphere { radius })];
    for (found, place) in [
        (
            refused(&text.replace("2,0,0,1,1", "2,0,1e9,1,1"), &good),
            "poses.csv: line 4, column `y`: ",
        ),
        (
            refused(&text.replace("2,0,0,1,1", "2,0,0,1,3"), &good),
            "poses.csv: line 4, the quaternion: ",
        ),
        (
            refused(&text.replace("2,0,0,1,1", "1,0,0,2,1"), &good),
            "poses.csv: line 4: has the time of line 3 of poses.csv, 1 s",
        ),
        (refused(&text.replace("2,0,0", "2e11,0,0"), &good), "poses.csv: line 4, time: "),
        (refused(text, &ImportOptions { gravity_m_s2: -9.81, ..good.clone() }), "--gravity: "),
        (refused(text, &ImportOptions { up: [0.0, 0.0, 2.0], ..good.clone() }), "--up: "),
        (refused(text, &ImportOptions { shapes: ball(-1.0), ..good.clone() }), "--sphere a: "),
    ] {
        assert!(found.starts_with(place), "{place} isn't in {found}");
    }
}

#[test]
fn warnings_point_to_the_table() {
    let text = "time,x,y,z\r\n0,0,0,1\r\n2,0,0,1\r\n1,0,0,1\r\n3,0,0,1\r\n4,0,0,1\r\n";
    let import = import_csv(&[Table { file: "poses.csv", text }], &options()).unwrap();
    let warnings = import.check().unwrap().warnings().to_vec();
    let is_named = |text: &str| text.contains("line 4 of poses.csv is earlier");
    assert!(warnings.iter().any(|warning| is_named(&warning.text)), "{warnings:?}");
    assert!(warnings.iter().all(|warning| !warning.text.contains("bodies[")), "{warnings:?}");
}
