//! Outputs that can't be written, or would cost an input.

use super::*;

#[test]
fn outputs_that_cannot_be_written_are_named() {
    let folder = folder_with(two_boxes().to_string().as_bytes());
    fs::create_dir(folder.path().join("folder")).unwrap();
    for (output, words) in [
        ("folder", "is a folder"),
        ("missing/result.json", "make the folder"),
        ("/proc/result.json", "choose another folder"),
        ("/dev/full", "space"),
    ] {
        let run = smash(folder.path(), &["reconstruct", "scene.json", "-o", output]);
        let message = refusal(output, &run);
        assert!(message.contains(output) && message.contains(words), "{message}");
    }
}

/// A reader that goes away, as `head` does, is no reason to panic.
#[test]
fn a_closed_pipe_is_an_error_and_no_panic() {
    let folder = folder_with(two_boxes().to_string().as_bytes());
    for arguments in [&["reconstruct", "scene.json", "-o", "-"][..], &["schema", "scene"]] {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = Command::new(env!("CARGO_BIN_EXE_smash"))
            .args(arguments)
            .current_dir(folder.path())
            .stdout(writer)
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{arguments:?}: {}: {stderr}", output.status);
        assert!(stderr.contains("(standard output)") && !stderr.contains("panicked"), "{stderr}");
    }
}

/// What was there before stays when the input is broken.
#[test]
fn a_failed_run_leaves_the_old_output() {
    let folder = folder_with(b"{}");
    let old = folder.path().join("result.json");
    fs::write(&old, "old").unwrap();
    refusal("broken", &smash(folder.path(), &["reconstruct", "scene.json", "-o", "result.json"]));
    assert_eq!(fs::read_to_string(old).unwrap(), "old");
}

/// A result in place of the annotations it was made of: they would be lost.
#[test]
fn no_input_is_overwritten() {
    let folder = folder_of_inputs();
    let import: Vec<&str> = ["import", "poses.csv"].into_iter().chain(FALL).collect();
    let commands = [
        ("scene.json", vec!["reconstruct", "scene.json"]),
        ("spec.json", vec!["simulate", "spec.json"]),
        ("spec.json", vec!["simulate", "spec.json", "-o", "new.json", "--truth"]),
        ("poses.csv", import),
    ];
    for (input, command) in commands {
        let old = fs::read(folder.path().join(input)).unwrap();
        for prefix in ["", "./", "symbolic-", "hard-"] {
            let output = format!("{prefix}{input}");
            let option = if command.last() == Some(&"--truth") { None } else { Some("-o") };
            let arguments: Vec<&str> =
                command.iter().copied().chain(option).chain([output.as_str()]).collect();
            let message = refusal(&output, &smash(folder.path(), &arguments));
            assert!(message.contains("choose another name"), "{message}");
            assert_eq!(fs::read(folder.path().join(input)).unwrap(), old, "{arguments:?}");
            assert!(!folder.path().join("new.json").exists(), "{arguments:?}");
        }
    }
}

#[test]
fn two_outputs_do_not_share_a_file() {
    let folder = folder_of_inputs();
    symlink("new.json", folder.path().join("link.json")).unwrap();
    for truth in ["new.json", "./new.json", "link.json"] {
        let arguments = ["simulate", "spec.json", "-o", "new.json", "--truth", truth];
        let message = refusal(truth, &smash(folder.path(), &arguments));
        assert!(message.contains("choose another name"), "{message}");
        assert!(!folder.path().join("new.json").exists());
    }
    let message =
        refusal("-", &smash(folder.path(), &["simulate", "spec.json", "-o", "-", "--truth", "-"]));
    assert!(message.contains("can't share"), "{message}");
}

/// The truth can't be written: then the old scene stays too.
#[test]
fn of_two_outputs_none_changes_if_one_fails() {
    let folder = folder_of_inputs();
    fs::write(folder.path().join("old.json"), "old").unwrap();
    let arguments = ["simulate", "spec.json", "-o", "old.json", "--truth", "/dev/full"];
    let message = refusal("full", &smash(folder.path(), &arguments));
    assert!(!message.contains("nothing was changed"), "a stream may hold a part: {message}");
    assert_eq!(fs::read_to_string(folder.path().join("old.json")).unwrap(), "old");
}

/// The link stays a link, and what it leads to keeps its mode.
#[test]
fn an_output_is_written_through_a_link() {
    let folder = folder_of_inputs();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("far")).unwrap();
    fs::write(path("far/old.json"), "old").unwrap();
    fs::set_permissions(path("far/old.json"), fs::Permissions::from_mode(0o640)).unwrap();
    for target in ["far/old.json", "far/new.json"] {
        symlink(target, path("link.json")).unwrap();
        let run = smash(folder.path(), &["simulate", "spec.json", "-o", "link.json"]);
        assert!(run.status.success(), "{}", run.stderr);
        assert!(path("link.json").is_symlink());
        assert!(fs::read_to_string(path(target)).unwrap().contains("smash.scene/1"));
        fs::remove_file(path("link.json")).unwrap();
    }
    assert_eq!(fs::metadata(path("far/old.json")).unwrap().permissions().mode() & 0o777, 0o640);
}
