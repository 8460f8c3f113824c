//! A struct of ours to JSON that people like to read.

use serde::Serialize;
use serde_json::Value;

/// The longest line that holds more than one value: an observation with all its digits.
const LONGEST_LINE: usize = 240;

/// `value` as indented JSON with a final newline. What is no deeper than a list within an object
/// (an observation, a shape) stays on one line, if it isn't too long.
pub(crate) fn pretty<T: Serialize>(value: &T) -> String {
    let tree = serde_json::to_value(value).expect("our structs have text keys and plain values");
    let mut text = String::new();
    write(&tree, 0, &mut text);
    text.push('\n');
    text
}

fn write(value: &Value, indent: usize, text: &mut String) {
    let broken = height(value) > 2 || value.to_string().len() > LONGEST_LINE;
    match value {
        Value::Array(items) => {
            write_items(items.iter().map(|item| (None, item)), ['[', ']'], broken, indent, text);
        }
        Value::Object(map) => {
            let fields = map.iter().map(|(key, item)| (Some(key), item));
            write_items(fields, ['{', '}'], broken, indent, text);
        }
        // A whole number reads best without its `.0`; it is the same number.
        Value::Number(number) => match number.as_f64() {
            Some(x) if x.fract() == 0.0 && x.abs() < 1e15 => text.push_str(&x.to_string()),
            _ => text.push_str(&number.to_string()),
        },
        plain => text.push_str(&plain.to_string()),
    }
}

fn write_items<'a>(
    items: impl Iterator<Item = (Option<&'a String>, &'a Value)>,
    [open, close]: [char; 2],
    broken: bool,
    indent: usize,
    text: &mut String,
) {
    let new_line = |text: &mut String, indent: usize| {
        text.push('\n');
        text.extend(std::iter::repeat_n(' ', indent));
    };
    text.push(open);
    for (index, (key, item)) in items.enumerate() {
        if index > 0 {
            text.push_str(if broken { "," } else { ", " });
        }
        if broken {
            new_line(text, indent + 2);
        }
        if let Some(key) = key {
            text.push_str(&Value::from(key.as_str()).to_string());
            text.push_str(": ");
        }
        write(item, indent + 2, text);
    }
    if broken {
        new_line(text, indent);
    }
    text.push(close);
}

/// How many lists and objects stand within each other.
fn height(value: &Value) -> usize {
    let tallest = match value {
        Value::Array(items) => items.iter().map(height).max(),
        Value::Object(map) => map.values().map(height).max(),
        _ => return 0,
    };
    1 + tallest.unwrap_or(0)
}
