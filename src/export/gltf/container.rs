//! The binary file around a film: a header, a chunk of JSON, a chunk of numbers (glTF 2.0, 4.4).

use serde_json::Value;

const VERSION: u32 = 2;

/// The bytes of a `.glb` file.
pub(super) fn glb(document: &Value, numbers: &[u8]) -> Vec<u8> {
    let json = document.to_string().into_bytes();
    let chunks = [chunk(b"JSON", json, b' '), chunk(b"BIN\0", numbers.to_vec(), 0)].concat();
    let length = 12 + chunks.len() as u32;
    [b"glTF".as_slice(), &VERSION.to_le_bytes(), &length.to_le_bytes(), &chunks].concat()
}

/// A chunk, filled up to a multiple of four bytes.
fn chunk(kind: &[u8; 4], mut content: Vec<u8>, filler: u8) -> Vec<u8> {
    content.resize(content.len().next_multiple_of(4), filler);
    [&(content.len() as u32).to_le_bytes(), kind.as_slice(), &content].concat()
}
