//! Effects: the catalogue keeps its contract, the language its rules, the command its word.

mod catalogue;
mod command;
mod contract;
mod inputs;
mod language;
mod law;
mod request;
mod schema;
mod worked;

/// An effect file with one law, `acceleration`, and a parameter `k` in `unit`.
fn with_acceleration(law: &str, unit: &str) -> String {
    effect(&format!("[parameters.k]\nunit = \"{unit}\"\nnull = 0\n[law]\nacceleration = \"{law}\""))
}

/// An effect file with `body` for its parameters and laws.
fn effect(body: &str) -> String {
    format!("name = \"mine\"\n{body}\n")
}
