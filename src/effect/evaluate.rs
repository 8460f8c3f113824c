//! Runs a program in plain f64, for checks of laws; the solver's own evaluator is in C++.

use nalgebra::{Quaternion, Vector3};

use super::names::ORIENTATION;
use super::program::{Instruction, Operation, Program};

impl Program {
    /// The result, of `length` 1 or 3, from the inputs and parameters, which fill the first
    /// registers.
    pub fn evaluate(&self, known: &[f64], length: usize) -> Vec<f64> {
        let mut registers = vec![0.0; usize::from(self.registers).max(known.len())];
        registers[..known.len()].copy_from_slice(known);
        for instruction in &self.instructions {
            run(instruction, &mut registers);
        }
        let result = usize::from(self.result);
        registers[result..result + length].to_vec()
    }
}

fn run(instruction: &Instruction, registers: &mut [f64]) {
    let (left, right) = (usize::from(instruction.left), usize::from(instruction.right));
    let target = usize::from(instruction.target);
    let vector = |at: usize| Vector3::from_column_slice(&registers[at..at + 3]);
    let result = match instruction.operation {
        Operation::VAdd => vector(left) + vector(right),
        Operation::VSub => vector(left) - vector(right),
        Operation::VScale => registers[left] * vector(right),
        Operation::VDiv => vector(left) / registers[right],
        Operation::VNeg => -vector(left),
        Operation::Cross => vector(left).cross(&vector(right)),
        Operation::Unit => unit(vector(left)),
        Operation::Rotate => turned(vector(left), orientation(registers)),
        Operation::Unrotate => turned(vector(left), orientation(registers).conjugate()),
        Operation::Dot => return registers[target] = vector(left).dot(&vector(right)),
        Operation::Norm => return registers[target] = vector(left).norm(),
        Operation::Constant => return registers[target] = instruction.value,
        scalar => return registers[target] = of_scalars(scalar, registers[left], registers[right]),
    };
    registers[target..target + 3].copy_from_slice(result.as_slice());
}

/// The result of an operation on one or two scalars.
pub(super) fn of_scalars(operation: Operation, left: f64, right: f64) -> f64 {
    match operation {
        Operation::Add => left + right,
        Operation::Sub => left - right,
        Operation::Mul => left * right,
        Operation::Div => left / right,
        Operation::Neg => -left,
        Operation::Pow => left.powf(right),
        // f64::min and f64::max would hide what isn't a number.
        Operation::Min if left.is_nan() || left < right => left,
        Operation::Max if left.is_nan() || left > right => left,
        Operation::Min | Operation::Max => right,
        Operation::Sqrt => left.sqrt(),
        Operation::Exp => left.exp(),
        Operation::Log => left.ln(),
        Operation::Sin => left.sin(),
        Operation::Cos => left.cos(),
        Operation::Tan => left.tan(),
        Operation::Asin => left.asin(),
        Operation::Acos => left.acos(),
        Operation::Atan => left.atan(),
        Operation::Atan2 => left.atan2(right),
        Operation::Tanh => left.tanh(),
        Operation::Abs => left.abs(),
        Operation::Sign => f64::from(i8::from(left > 0.0) - i8::from(left < 0.0)),
        Operation::Step => f64::from(u8::from(left >= 0.0)),
        Operation::Same => {
            let size = 1.0_f64.max(left.abs()).max(right.abs());
            f64::from(u8::from((left - right).abs() <= 1e-9 * size))
        }
        _ => left,
    }
}

/// The direction; 0 at 0.
fn unit(vector: Vector3<f64>) -> Vector3<f64> {
    let norm = vector.norm();
    if norm == 0.0 { Vector3::zeros() } else { vector / norm }
}

fn orientation(registers: &[f64]) -> Quaternion<f64> {
    let [w, x, y, z] = [0, 1, 2, 3].map(|part| registers[usize::from(ORIENTATION) + part]);
    Quaternion::new(w, x, y, z)
}

fn turned(vector: Vector3<f64>, by: Quaternion<f64>) -> Vector3<f64> {
    (by * Quaternion::from_imag(vector) * by.conjugate()).imag()
}
