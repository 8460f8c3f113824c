//! An expression that is understood to the instructions that compute it.

use super::check::{Meaning, Value};
use super::names::Shape;
use super::program::{Instruction, Operation, Program};

/// The program of `value`; registers from `first` on are free.
pub(super) fn compile(value: &Value, first: u16) -> Program {
    let mut emitter = Emitter { instructions: Vec::new(), next: first };
    let result = emitter.value(value);
    Program { instructions: emitter.instructions, registers: emitter.next, result }
}

struct Emitter {
    instructions: Vec<Instruction>,
    /// The first register that is free.
    next: u16,
}

impl Emitter {
    /// Emits what computes `value`, and says in which register it then is.
    fn value(&mut self, value: &Value) -> u16 {
        match &value.meaning {
            Meaning::Known(register) => *register,
            Meaning::Component(of, axis) => self.value(of) + axis,
            Meaning::Constant(number) => self.once(Operation::Constant, [0, 0], *number, 1),
            Meaning::Vector(items) => {
                let from: Vec<u16> = items.iter().map(|item| self.value(item)).collect();
                let target = self.reserve(3);
                for (at, register) in (target..).zip(from) {
                    self.emit(Operation::Copy, at, [register, register], 0.0);
                }
                target
            }
            Meaning::Apply(operation, values) => {
                let from: Vec<u16> = values.iter().map(|value| self.value(value)).collect();
                let right = *from.get(1).unwrap_or(&from[0]);
                let length = if value.shape == Shape::Vector { 3 } else { 1 };
                self.once(*operation, [from[0], right], 0.0, length)
            }
        }
    }

    /// Emits an instruction, unless the same was emitted before: no register is written twice, so
    /// its result still stands.
    fn once(&mut self, operation: Operation, operands: [u16; 2], value: f64, length: u16) -> u16 {
        let is_same = |earlier: &&Instruction| {
            earlier.operation == operation
                && [earlier.left, earlier.right] == operands
                && earlier.value.to_bits() == value.to_bits()
        };
        if let Some(earlier) = self.instructions.iter().find(is_same) {
            return earlier.target;
        }
        let target = self.reserve(length);
        self.emit(operation, target, operands, value);
        target
    }

    fn reserve(&mut self, registers: u16) -> u16 {
        let target = self.next;
        // No overflow: a law has at most a thousand tokens.
        self.next += registers;
        target
    }

    fn emit(&mut self, operation: Operation, target: u16, [left, right]: [u16; 2], value: f64) {
        self.instructions.push(Instruction { operation, target, left, right, value });
    }
}
