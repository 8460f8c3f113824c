# Finds and installs what scripts/dependencies.txt lists. Sourced by ./setup, ./check and .ci/run,
# from the repository's folder.
# shellcheck shell=bash

readonly DEPENDENCIES=scripts/dependencies.txt

# read_options "$@": sets `yes` and `dry_run`, or explains itself and exits. The text of the help
# is the script's first block of comments.
read_options() {
    yes=false dry_run=false
    local option
    for option in "$@"; do
        case $option in
            --yes) yes=true ;;
            --dry-run) dry_run=true ;;
            --help) sed -n '2,/^$/s/^# \{0,1\}//p' "$0" && exit 0 ;;
            *) echo "error: unknown option $option; try $0 --help" >&2 && exit 2 ;;
        esac
    done
}

# stop TEXT…: one message, a line for each argument, and the end.
stop() {
    printf 'error: %s\n' "$1" >&2
    shift
    (($# == 0)) || printf '  %s\n' "$@" >&2
    exit 1
}

# require_rust: finds cargo, also where rustup puts it, and checks that it is recent enough.
require_rust() {
    command -v cargo >/dev/null || PATH="$PATH:${CARGO_HOME:-$HOME/.cargo}/bin"
    command -v cargo >/dev/null || stop "Rust's cargo isn't in PATH" \
        "install Rust as https://rustup.rs says, open a new shell, and run $0 again"
    local needed found
    needed=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' Cargo.toml)
    found=$(cargo --version | cut -d' ' -f2)
    [[ $(printf '%s\n' "$needed" "$found" | sort -V | head -n1) == "$needed" ]] || stop \
        "cargo is version $found, smash needs $needed or later" \
        "rustup update stable (Debian's own cargo is too old: https://rustup.rs), and run $0 again"
    echo "found    cargo $found"
}

# require WORK…: shows what is there for each kind of work, and installs what isn't.
require() {
    missing=()
    look_for "$@"
    ((${#missing[@]} > 0)) || return 0
    ! "$dry_run" || stop "missing: ${missing[*]}" "on Debian: sudo apt-get install ${missing[*]}"
    install_packages "${missing[@]}"
    missing=()
    look_for "$@"
    ((${#missing[@]} == 0)) || stop "still missing after the installation: ${missing[*]}"
}

# look_for WORK…: prints a line for each dependency, and fills `missing` with packages.
look_for() {
    local work probe package purpose
    while read -r work probe package purpose; do
        [[ " $* " == *" $work "* ]] || continue
        if is_there "$probe"; then
            echo "found    $package"
        else
            echo "missing  $package: $purpose"
            missing+=("$package")
        fi
    done <"$DEPENDENCIES"
}

# is_there PROBE: whether `command:…`, `header:…` or `file:…` exists.
is_there() {
    local name=${1#*:} folder
    case $1 in
        command:*) command -v "$name" >/dev/null ;;
        file:*) [[ -e $name ]] ;;
        header:*)
            for folder in ${SMASH_CERES_INCLUDE:+"$SMASH_CERES_INCLUDE"} /usr/include /usr/local/include; do
                [[ ! -e $folder/$name ]] || return 0
            done
            return 1
            ;;
        *) stop "$DEPENDENCIES: unknown probe $1" ;;
    esac
}

# install_packages PACKAGE…: by apt-get, after asking.
install_packages() {
    command -v apt-get >/dev/null || stop \
        "this system has no apt-get, so it can't install what is missing" \
        "Debian calls it: $*" "install the same by your system's means, and run $0 again"
    local as_root=()
    if ((EUID != 0)); then
        command -v sudo >/dev/null || stop "installing needs root, and sudo isn't here" \
            "as root: apt-get install $*" "then run $0 again as yourself"
        as_root=(sudo)
    fi
    echo "To install as root: apt-get install $*"
    confirm
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get)
    # Lists of packages that are absent don't know these; old ones name files that are gone. An
    # update may fail for a source that smash doesn't need: the installation decides.
    apt-get install --simulate "$@" >/dev/null 2>&1 || "${apt[@]}" update || true
    "${apt[@]}" install --yes --no-install-recommends "$@" && return
    "${apt[@]}" update || true
    "${apt[@]}" install --yes --no-install-recommends "$@" ||
        stop "apt-get couldn't install $*; its own message stands above"
}

# confirm: returns when --yes was given or the user agrees.
confirm() {
    ! "$yes" || return 0
    [[ -t 0 ]] || stop "there is no terminal to ask at" \
        "$0 --yes installs without asking; or install the packages yourself"
    local answer
    read -r -p "Go ahead? [y/N] " answer
    [[ $answer == [yY]* ]] || stop "nothing was installed"
}

# run_main_job PROGRAM: reconstructs a scene of the repository into result.json.
run_main_job() {
    echo "+ $1 reconstruct scenes/boxes.json -o result.json"
    "$1" reconstruct scenes/boxes.json -o result.json
}
