// The evaluator of an effect's law: a flat list of operations over registers, for any scalar, so
// that automatic differentiation passes through.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "dynamics/rotation.h"
#include "dynamics/vector.h"

namespace smash {

// What a law tells. The numbers are those of the effect language's compiler.
enum class Hook : std::uint8_t {
  kAcceleration,
  kTorque,
  kInertia,
  kTime,
  kPosition,
  kOrientation,
  kImpulse,
  kImpulsePoint,
  kAngularImpulse,
  kEventTime,
  kEventImpulse,
  kEventAngularImpulse,
};
inline constexpr int kHooks = 12;

// Where the names that a law may use stand; a vector takes three registers, q four.
enum LawInput : int {
  kInputTime = 0,
  kInputPosition = 1,
  kInputVelocity = 4,
  kInputOrientation = 7,
  kInputOmega = 11,
  kInputSpin = 14,
  kInputUp = 17,
  kInputGravity = 20,
  kInputCamera = 23,
  kInputNormal = 26,
  kInputSize = 29,
  kInputMass = 32,
  kInputImpulse = 33,
  kInputContact = 36,
  kInputSlip = 39,
  kInputAcross1 = 42,
  kInputAcross2 = 45,
  kInputCollisionTime = 48,
  // From here on the parameters, then temporaries.
  kInputs = 49,
};

enum class Operation : std::uint8_t {
  kConstant,
  kAdd,
  kSubtract,
  kMultiply,
  kDivide,
  kNegate,
  kPower,
  kMinimum,
  kMaximum,
  kSquareRoot,
  kExponential,
  kLogarithm,
  kSine,
  kCosine,
  kTangent,
  kArcSine,
  kArcCosine,
  kArcTangent,
  kArcTangent2,
  kHyperbolicTangent,
  kAbsolute,
  kSign,
  kStep,
  kSame,
  kCopy,
  kAddVectors = 30,
  kSubtractVectors,
  kScaleVector,
  kDivideVector,
  kNegateVector,
  kDot,
  kCross,
  kNorm,
  kUnit,
  kRotate,
  kUnrotate,
  kEnd,
};

// Whether an operation works on vectors, and whether it makes one: for bounds of registers.
struct OperandSizes {
  int target, left, right;
};
inline OperandSizes SizesOf(Operation operation) {
  switch (operation) {
    case Operation::kAddVectors:
    case Operation::kSubtractVectors:
    case Operation::kCross:
      return {3, 3, 3};
    case Operation::kScaleVector:
      return {3, 1, 3};
    case Operation::kDivideVector:
      return {3, 3, 1};
    case Operation::kNegateVector:
    case Operation::kUnit:
    case Operation::kRotate:
    case Operation::kUnrotate:
      return {3, 3, 1};
    case Operation::kDot:
      return {1, 3, 3};
    case Operation::kNorm:
      return {1, 3, 1};
    default:
      return {1, 1, 1};
  }
}

struct Instruction {
  Operation operation;
  std::uint16_t target, left, right;
  double value;
};

struct Law {
  Hook hook;
  int registers, result;
  std::vector<Instruction> instructions;
  // Bit i: whether anything reads register i, of the inputs.
  std::uint64_t used = 0;

  // Fills `used` in.
  void FindUsed() {
    Mark(result, 3);
    for (const Instruction& i : instructions) {
      const OperandSizes sizes = SizesOf(i.operation);
      Mark(i.left, sizes.left);
      Mark(i.right, sizes.right);
      const bool turns = i.operation == Operation::kRotate || i.operation == Operation::kUnrotate;
      if (turns) Mark(kInputOrientation, 4);
    }
  }

  bool Uses(int place, int size) const { return (used >> place & ((1u << size) - 1u)) != 0; }

 private:
  void Mark(int place, int size) {
    for (int i = place; i < place + size && i < kInputs; ++i) used |= std::uint64_t{1} << i;
  }
};

// A law with registers of its own.
template <typename T>
class LawRun {
 public:
  explicit LawRun(const Law& law) : law_(&law), registers_(law.registers, T(0)) {
    for (const Instruction& i : law.instructions) {
      if (i.operation == Operation::kConstant) registers_[i.target] = T(i.value);
    }
  }

  const Law& law() const { return *law_; }
  // Of an input that the law doesn't read they do nothing.
  void Set(int place, const T& value) {
    if (place >= kInputs || law_->Uses(place, 1)) registers_[place] = value;
  }
  void SetVector(int place, const Vector3<T>& value) {
    if (law_->Uses(place, 3)) VectorAt(place) = value;
  }
  void SetQuaternion(int place, const Quaternion<T>& value) {
    if (!law_->Uses(place, 4)) return;
    for (int i = 0; i < 4; ++i) registers_[place + i] = value[i];
  }

  T Scalar() {
    Run();
    return registers_[law_->result];
  }
  Vector3<T> Vector() {
    Run();
    return Vector3<T>(VectorAt(law_->result));
  }

 private:
  Eigen::Map<Vector3<T>> VectorAt(int place) { return Eigen::Map<Vector3<T>>(&registers_[place]); }

  void Run() {
    for (const Instruction& i : law_->instructions) Do(i);
  }

  void Do(const Instruction& i) {
    using std::acos;
    using std::asin;
    using std::atan;
    using std::atan2;
    using std::cos;
    using std::exp;
    using std::log;
    using std::sin;
    using std::tan;
    using std::tanh;
    T& to = registers_[i.target];
    const T& a = registers_[i.left];
    const T& b = registers_[i.right];
    switch (i.operation) {
      case Operation::kConstant:
        return;
      case Operation::kAdd:
        to = a + b;
        return;
      case Operation::kSubtract:
        to = a - b;
        return;
      case Operation::kMultiply:
        to = a * b;
        return;
      case Operation::kDivide:
        to = a / b;
        return;
      case Operation::kNegate:
        to = -a;
        return;
      case Operation::kPower:
        to = Power(a, b);
        return;
      case Operation::kMinimum:
        to = b < a ? b : a;
        return;
      case Operation::kMaximum:
        to = a < b ? b : a;
        return;
      case Operation::kSquareRoot:
        to = Root(a);
        return;
      case Operation::kExponential:
        to = exp(a);
        return;
      case Operation::kLogarithm:
        to = log(a);
        return;
      case Operation::kSine:
        to = sin(a);
        return;
      case Operation::kCosine:
        to = cos(a);
        return;
      case Operation::kTangent:
        to = tan(a);
        return;
      case Operation::kArcSine:
        to = asin(a);
        return;
      case Operation::kArcCosine:
        to = acos(a);
        return;
      case Operation::kArcTangent:
        to = atan(a);
        return;
      case Operation::kArcTangent2:
        to = a == T(0) && b == T(0) ? T(0) : atan2(a, b);
        return;
      case Operation::kHyperbolicTangent:
        to = tanh(a);
        return;
      case Operation::kAbsolute:
        to = a < T(0) ? -a : a;
        return;
      case Operation::kSign:
        to = a < T(0) ? T(-1) : a > T(0) ? T(1) : T(0);
        return;
      case Operation::kStep:
        to = a < T(0) ? T(0) : T(1);
        return;
      case Operation::kSame:
        to = IsSame(a, b) ? T(1) : T(0);
        return;
      case Operation::kCopy:
        to = a;
        return;
      case Operation::kAddVectors:
        VectorAt(i.target) = VectorAt(i.left) + VectorAt(i.right);
        return;
      case Operation::kSubtractVectors:
        VectorAt(i.target) = VectorAt(i.left) - VectorAt(i.right);
        return;
      case Operation::kScaleVector:
        for (int k = 0; k < 3; ++k) (&to)[k] = a * (&b)[k];
        return;
      case Operation::kDivideVector:
        for (int k = 0; k < 3; ++k) (&to)[k] = (&a)[k] / b;
        return;
      case Operation::kNegateVector:
        VectorAt(i.target) = -VectorAt(i.left);
        return;
      case Operation::kDot:
        to = VectorAt(i.left).dot(VectorAt(i.right));
        return;
      case Operation::kCross: {
        const Vector3<T> cross = VectorAt(i.left).cross(VectorAt(i.right));
        VectorAt(i.target) = cross;
        return;
      }
      case Operation::kNorm:
        to = Root(T(VectorAt(i.left).squaredNorm()));
        return;
      case Operation::kUnit: {
        const Vector3<T> v = VectorAt(i.left);
        const T length = Root(T(v.squaredNorm()));
        if (length == T(0)) {
          VectorAt(i.target).setConstant(T(0));
        } else {
          VectorAt(i.target) = v / length;
        }
        return;
      }
      case Operation::kRotate:
      case Operation::kUnrotate: {
        const bool back = i.operation == Operation::kUnrotate;
        const Vector3<T> axis = VectorAt(kInputOrientation + 1);
        const Vector3<T> u = back ? Vector3<T>(-axis) : axis;
        const Vector3<T> v = VectorAt(i.left);
        VectorAt(i.target) = Rotate(registers_[kInputOrientation], u, v);
        return;
      }
      case Operation::kEnd:
        return;
    }
  }

  // At zero the derivative would be infinite; the laws of motion have none there that matters.
  static T Root(const T& a) {
    using std::sqrt;
    return a > T(0) ? sqrt(a) : T(0);
  }
  static T Power(const T& a, const T& b) {
    using std::pow;
    return a == T(0) ? (b == T(0) ? T(1) : T(0)) : pow(a, b);
  }
  static bool IsSame(const T& a, const T& b) {
    const T apart = a - b;
    const T limit = T(1e-9) * (T(1) + (a < T(0) ? -a : a));
    return apart < limit && -apart < limit;
  }

  const Law* law_;
  std::vector<T> registers_;
};

}  // namespace smash
