//! A law as the evaluators run it: a flat list of instructions on numbered registers.
//!
//! A vector takes three registers in a row. First come the inputs (see `names.rs`), then the
//! effect's parameters in their order, then what is computed.

/// What an instruction does with the registers `left` and `right`, or with `value`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
#[allow(missing_docs)] // Their names say it; `evaluate.rs` says it exactly.
pub enum Operation {
    Constant = 0,
    Add = 1,
    Sub = 2,
    Mul = 3,
    Div = 4,
    Neg = 5,
    Pow = 6,
    Min = 7,
    Max = 8,
    Sqrt = 9,
    Exp = 10,
    Log = 11,
    Sin = 12,
    Cos = 13,
    Tan = 14,
    Asin = 15,
    Acos = 16,
    Atan = 17,
    Atan2 = 18,
    Tanh = 19,
    Abs = 20,
    Sign = 21,
    Step = 22,
    Same = 23,
    Copy = 24,
    VAdd = 30,
    VSub = 31,
    /// A scalar on the left times a vector on the right.
    VScale = 32,
    /// A vector on the left over a scalar on the right.
    VDiv = 33,
    VNeg = 34,
    Dot = 35,
    Cross = 36,
    Norm = 37,
    Unit = 38,
    Rotate = 39,
    Unrotate = 40,
}

/// One step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Instruction {
    /// What is done.
    pub operation: Operation,
    /// The (first) register of the result.
    pub target: u16,
    /// The (first) register of the first operand.
    pub left: u16,
    /// The (first) register of the second operand, if there is one.
    pub right: u16,
    /// The number of a [`Operation::Constant`].
    pub value: f64,
}

/// A law, compiled.
#[derive(Debug, Clone, PartialEq)]
pub struct Program {
    /// In order.
    pub instructions: Vec<Instruction>,
    /// How many registers it needs in all.
    pub registers: u16,
    /// The (first) register of the result.
    pub result: u16,
}
