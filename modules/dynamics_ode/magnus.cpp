// Torque-free rotation by a Magnus series, of one body or of two side by side in the lanes of a register: a step mostly
// waits for its own last result, so that two take little longer than one. Both give the same bits; sums are in the
// order in which Eigen adds up its products.
#include <algorithm>
#include <cmath>

#include "modules/dynamics_ode/rotation.h"

namespace presa::ode {
namespace magnus {
namespace {

constexpr double kMaxAngle = 0.05;  // [rad] per series
constexpr int kMaxSubsteps = 64;

using Two = double __attribute__((vector_size(16)));  // a number of two bodies
double lane(double a, int /*of one*/) { return a; }
double lane(const Two& a, int body) { return a[body]; }

// In what follows, Number is double or Two.
template <class Number>
struct Triple {
  Number x, y, z;
  friend Triple operator+(const Triple& a, const Triple& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Triple operator*(double s, const Triple& a) { return {s * a.x, s * a.y, s * a.z}; }
  friend Triple operator/(const Triple& a, double s) { return {a.x / s, a.y / s, a.z / s}; }
  Triple cross(const Triple& b) const { return {y * b.z - z * b.y, z * b.x - x * b.z, x * b.y - y * b.x}; }
  Triple scaledBy(const Number& s) const { return {x * s, y * s, z * s}; }
  Triple times(const Triple& b) const { return {x * b.x, y * b.y, z * b.z}; }  // number by number
  Number dot(const Triple& b) const { return x * b.x + y * b.y + z * b.z; }
};

template <class Number>
struct Matrix {
  Triple<Number> a, b, c;  // columns
  Triple<Number> operator*(const Triple<Number>& v) const {
    return {a.x * v.x + b.x * v.y + c.x * v.z, a.y * v.x + b.y * v.y + c.y * v.z, a.z * v.x + (b.z * v.y + c.z * v.z)};
  }
  Triple<Number> transposedTimes(const Triple<Number>& v) const { return {a.dot(v), b.dot(v), c.dot(v)}; }
};

template <class Number>
struct Rotor {  // a unit quaternion
  Number x, y, z, w;
  Rotor operator*(const Rotor& b) const {
    return {(w * b.x + y * b.z) - (z * b.y - x * b.w), (w * b.y + y * b.w) + (z * b.x - x * b.z),
            (w * b.z - y * b.x) + (z * b.w + x * b.y), (w * b.w - y * b.y) - (z * b.z + x * b.x)};
  }
  Matrix<Number> matrix() const {
    const Number x2 = 2.0 * x, y2 = 2.0 * y, z2 = 2.0 * z;
    const Number wx = x2 * w, wy = y2 * w, wz = z2 * w, xx = x2 * x, xy = y2 * x, xz = z2 * x;
    const Number yy = y2 * y, yz = z2 * y, zz = z2 * z;
    return {
        {1.0 - (yy + zz), xy + wz, xz - wy}, {xy - wz, 1.0 - (xx + zz), yz + wx}, {xz + wy, yz - wx, 1.0 - (xx + yy)}};
  }
  // By a step of Newton's method, which doubles the digits of a norm that is nearly 1.
  Rotor renormalised() const {
    const Number s = 1.5 - 0.5 * ((x * x + z * z) + (y * y + w * w));
    return {x * s, y * s, z * s, w * s};
  }
};

// The rotation vector over `h` of a body with angular momentum L, in the axes of the body, from the derivatives of its
// angular velocity by Euler's equations L' = L x w. `spin_of(L)` is w.
template <class Number, class SpinOf>
Triple<Number> magnusTurn(const Triple<Number>& L, const SpinOf& spin_of, double h) {
  const Triple<Number> w = spin_of(L), L1 = L.cross(w), w1 = spin_of(L1);
  const Triple<Number> L2 = L1.cross(w) + L.cross(w1), w2 = spin_of(L2);
  const Triple<Number> w3 = spin_of(L2.cross(w) + 2 * L1.cross(w1) + L.cross(w2));
  const Triple<Number> commutator = w.cross(w1 + h / 2 * w2) / 12;
  return h * (w + h * (w1 / 2 + h * (w2 / 6 + commutator + h / 24 * w3)));
}

// exp(turn / 2) by its series, to rounding for turns of kMaxAngle
template <class Number>
Rotor<Number> smallTurn(const Triple<Number>& turn) {
  const Number a = turn.dot(turn) / 4.0;
  const Number cosine = 1.0 - a / 2.0 * (1.0 - a / 12.0 * (1.0 - a / 30.0 * (1.0 - a / 56.0)));
  const Triple<Number> v = turn.scaledBy(0.5 * (1.0 - a / 6.0 * (1.0 - a / 20.0 * (1.0 - a / 42.0))));
  return {v.x, v.y, v.z, cosine};
}

template <class Number, class... Vectors>
Triple<Number> tripleOf(const Vectors&... v) {
  return {Number{v.x()...}, Number{v.y()...}, Number{v.z()...}};
}
template <class Number, class... Matrices>
Matrix<Number> matrixOf(const Matrices&... m) {
  return {tripleOf<Number>(m.col(0)...), tripleOf<Number>(m.col(1)...), tripleOf<Number>(m.col(2)...)};
}
template <class Number, class... Quats>
Rotor<Number> rotorOf(const Quats&... q) {
  return {Number{q.x()...}, Number{q.y()...}, Number{q.z()...}, Number{q.w()...}};
}

template <class Number, class SpinOf>
void turn(Rotor<Number>& q_WB, Triple<Number>& w_WB, const Matrix<Number>& inertia, const SpinOf& spin_of, double h,
          int substeps) {
  Matrix<Number> R = q_WB.matrix();
  Triple<Number> L_B = inertia * R.transposedTimes(w_WB);
  const Triple<Number> L_W = R * L_B;
  for (int i = 0; i < substeps; ++i) {
    q_WB = (q_WB * smallTurn(magnusTurn(L_B, spin_of, h / substeps))).renormalised();
    R = q_WB.matrix();
    L_B = R.transposedTimes(L_W);
  }
  w_WB = R * spin_of(L_B);
}

// Of most bodies the axes are principal ones: the same bits in less time.
bool isDiagonal(const Turning& body) {
  const Mat3& m = body.inverse_inertia;  // symmetric
  return m(1, 0) == 0 && m(2, 0) == 0 && m(2, 1) == 0;
}

int substepsOf(const Turning& body, double h) {
  const double squared_angle = h * h * body.w_WB.squaredNorm();
  if (!(squared_angle > kMaxAngle * kMaxAngle)) return 1;
  return std::clamp(static_cast<int>(std::ceil(std::sqrt(squared_angle) / kMaxAngle)), 1, kMaxSubsteps);
}

// One body or, with Two, two.
template <class Number, class... Bodies>
void turnTogether(bool diagonal, double h, int substeps, const Bodies&... bodies) {
  auto q_WB = rotorOf<Number>(bodies.q_WB...);
  auto w_WB = tripleOf<Number>(bodies.w_WB...);
  const auto inertia = matrixOf<Number>(bodies.inertia...);
  if (diagonal) {
    const auto inverse = tripleOf<Number>(bodies.inverse_inertia.diagonal()...);
    turn(
        q_WB, w_WB, inertia, [&](const auto& L) { return inverse.times(L); }, h, substeps);
  } else {
    const auto inverse = matrixOf<Number>(bodies.inverse_inertia...);
    turn(
        q_WB, w_WB, inertia, [&](const auto& L) { return inverse * L; }, h, substeps);
  }
  const auto give = [&](const Turning& body, int i) {
    body.q_WB = Quat(lane(q_WB.w, i), lane(q_WB.x, i), lane(q_WB.y, i), lane(q_WB.z, i));
    body.w_WB = Vec3(lane(w_WB.x, i), lane(w_WB.y, i), lane(w_WB.z, i));
  };
  int i = 0;
  (give(bodies, i++), ...);
}

}  // namespace
}  // namespace magnus

void magnusRotation(Quat& q_WB, Vec3& w_WB, const Mat3& inertia, const Mat3& inverse_inertia, double h) {
  const Turning body{q_WB, w_WB, inertia, inverse_inertia};
  magnus::turnTogether<double>(magnus::isDiagonal(body), h, magnus::substepsOf(body, h), body);
}

void magnusRotations(const Turning& first, const Turning& second, double h) {
  const bool diagonal = magnus::isDiagonal(first);
  const int substeps = magnus::substepsOf(first, h);
  if (diagonal == magnus::isDiagonal(second) && substeps == magnus::substepsOf(second, h)) {
    magnus::turnTogether<magnus::Two>(diagonal, h, substeps, first, second);
  } else {
    for (const Turning* of : {&first, &second}) magnusRotation(of->q_WB, of->w_WB, of->inertia, of->inverse_inertia, h);
  }
}

}  // namespace presa::ode
