//! Compiles the C++ side (`cpp/`) and links Debian's Ceres.
//!
//! `SMASH_CERES_INCLUDE` and `SMASH_CERES_LIB` name other folders for the headers and the
//! libraries; `SMASH_CXX_FLAGS` adds compiler flags (the sanitizer script uses it).

use std::path::{Path, PathBuf};

/// Debian's folders of headers; the first that holds Ceres wins.
const INCLUDE_FOLDERS: [&str; 2] = ["/usr/include", "/usr/local/include"];

fn main() {
    for name in ["SMASH_CERES_INCLUDE", "SMASH_CERES_LIB", "SMASH_CXX_FLAGS", "DOCS_RS"] {
        println!("cargo:rerun-if-env-changed={name}");
    }
    println!("cargo:rerun-if-changed=cpp");
    // Documentation needs no C++; machines that only build pages have none.
    if std::env::var_os("DOCS_RS").is_some() {
        return;
    }
    let include = ceres_include_folder();
    let mut build = cxx_build::bridges(
        ["flight_reference", "paper", "refined"].map(|name| format!("src/bridge/{name}.rs")),
    );
    build
        .file("cpp/acting_effects.cc")
        .file("cpp/bridge.cc")
        .file("cpp/flight_fits.cc")
        .file("cpp/flight_reference.cc")
        .file("cpp/flight_steps.cc")
        .file("cpp/paper_problem.cc")
        .file("cpp/refined_blocks.cc")
        .file("cpp/refined_bridge.cc")
        .file("cpp/refined_problem.cc")
        .file("cpp/refined_summary.cc")
        .file("cpp/validate_paper.cc")
        .file("cpp/validate_refined.cc")
        .include("cpp")
        // As system headers: their warnings aren't ours.
        .flag(format!("-isystem{}", include.join("eigen3").display()))
        .std("c++17")
        // Unoptimised templates on the scalar run fifty times slower, in every profile.
        .opt_level(3)
        // Derivatives are short loops in deep templates: left as calls they take twice as long.
        .flag_if_supported("-finline-limit=5000")
        .flag_if_supported("--param=large-function-growth=1000")
        .flag_if_supported("--param=inline-unit-growth=400")
        // Eigen checks every assignment of every jet else; what is given is checked before.
        .define("NDEBUG", None)
        .flag_if_supported("-Wall")
        .flag_if_supported("-Wextra");
    if include != Path::new("/usr/include") {
        build.include(&include);
    }
    if let Ok(flags) = std::env::var("SMASH_CXX_FLAGS") {
        for flag in flags.split_whitespace() {
            build.flag(flag);
        }
    }
    build.compile("smash_cpp");
    if let Ok(folder) = std::env::var("SMASH_CERES_LIB") {
        println!("cargo:rustc-link-search=native={folder}");
    }
    println!("cargo:rustc-link-lib=ceres");
    // Ceres' headers refer to glog's symbols: both must be named to the linker.
    println!("cargo:rustc-link-lib=glog");
}

fn ceres_include_folder() -> PathBuf {
    let named = std::env::var_os("SMASH_CERES_INCLUDE").map(PathBuf::from);
    let candidates: Vec<PathBuf> = match named {
        Some(folder) => vec![folder],
        None => INCLUDE_FOLDERS.iter().map(PathBuf::from).collect(),
    };
    let holds_ceres = |folder: &PathBuf| folder.join("ceres/version.h").is_file();
    candidates.iter().find(|folder| holds_ceres(folder)).cloned().unwrap_or_else(|| {
        let looked: Vec<_> = candidates.iter().map(|f| f.display().to_string()).collect();
        eprintln!(
            "\nerror: the headers of Ceres Solver (2.1 or later) are not in {}.\n\
             On Debian: sudo apt-get install g++ libceres-dev libeigen3-dev\n\
             (or run ./setup, or set SMASH_CERES_INCLUDE and SMASH_CERES_LIB)\n",
            looked.join(" or ")
        );
        std::process::exit(1)
    })
}
