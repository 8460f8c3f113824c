//! The ledger of a collision as a table.

use smash::compare::{Ledger, LedgerEntry, LedgerLine};

use super::table::{aligned, decimals, digits_of};

/// What people look for, in this order; the rest stands in the file.
const SHOWN: [(&str, &str); 5] = [
    ("momentum", "momentum"),
    ("angular_momentum", "angular momentum"),
    ("translational_energy", "energy of flight"),
    ("rotational_energy", "energy of spin"),
    ("energy", "energy"),
];

/// The table, with its title.
pub fn in_words(ledger: &Ledger) -> String {
    let mut rows = vec![["", "", "before", "after", "change"].map(String::from).to_vec()];
    for (quantity, label) in SHOWN {
        // The sum of energies is of interest for all together.
        let lines = ledger.lines.iter().filter(|line| line.quantity == quantity);
        let last = ledger.lines.last().map(|line| &line.body);
        rows.extend(
            lines
                .filter(|line| quantity != "energy" || Some(&line.body) == last)
                .map(|line| row(line, label)),
        );
    }
    let title = "At the collision, per kg of the reference body, in SI units; angular momentum and height \
                 are from\nthe point of contact";
    // A lone body's momentum changes by whatever it hit.
    let is_alone = ledger.lines.iter().all(|line| line.body.is_some());
    let note = match is_alone {
        true => {
            "The change of momentum and angular momentum went into what it hit: the plane, or a body \
                 that isn't in\nthe scene\n"
        }
        false => "",
    };
    format!("\n{title}\n{}{note}", aligned(&rows))
}

fn row(line: &LedgerLine, label: &str) -> Vec<String> {
    let change = match (line.change.value.as_deref(), line.change.std.as_slice()) {
        (Some(&[value]), &[Some(std)]) => {
            let digits = digits_of(std);
            format!("{:>7} ± {}", decimals(value, digits), decimals(std, digits))
        }
        _ => cell(&line.change),
    };
    let body = line.body.clone().unwrap_or("all".into());
    vec![label.into(), body, cell(&line.before), cell(&line.after), change]
}

fn cell(entry: &LedgerEntry) -> String {
    match entry.value.as_deref() {
        None => "not determined".into(),
        Some(numbers) => numbers.iter().map(|one| number(*one)).collect::<Vec<_>>().join(" "),
    }
}

fn number(value: f64) -> String {
    format!("{:>7}", decimals(value, 3))
}
