//! Times that nothing can be cut at.

use std::process::Command;

fn refused(arguments: &[&str]) -> String {
    let folder = tempfile::tempdir().unwrap();
    let scene = format!("{}/scenes/boxes.json", env!("CARGO_MANIFEST_DIR"));
    let mut command = Command::new(env!("CARGO_BIN_EXE_smash"));
    let command = command.args(["cut", &scene, "-o", "rest.json"]).args(arguments);
    let output = command.current_dir(folder.path()).output().unwrap();
    assert!(!output.status.success());
    assert!(!folder.path().join("rest.json").exists(), "a file in spite of {arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn no_pose_or_all_of_a_body_is_not_cut() {
    for [from, to] in [["50", "51"], ["0.9", "0.2"], ["nan", "1"]] {
        let told = refused(&["--from", from, "--to", to]);
        assert!(told.contains("no pose") && told.contains("hint"), "{told}");
    }
    let told = refused(&["--from", "-1", "--to", "1e9"]);
    assert!(told.contains("observation") && told.contains("hint"), "{told}");
}
