// The few transcendental functions whose results decide something, with the same bits on every
// machine.
//
// The C library chooses its kernels by processor (with or without fused multiply-add), and their
// last bits differ. These use additions, multiplications, divisions and square roots alone, which
// IEEE 754 rounds correctly everywhere (with contraction off): argument reduction to a small
// interval, then a Taylor series long enough for its remainder to vanish beside the rounding. They
// are good to a few units in the last place, not correctly rounded.
#pragma once

#include <span>

namespace plumb {

inline constexpr double kPi = 3.14159265358979323846;

constexpr double radians(double degrees) { return degrees * (kPi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / kPi); }

/// Sine and cosine of an angle in radians, |angle| <= 1e6 (NaN beyond); error below 4e-16 absolute
/// near zero turns, growing as 1e-16 per radian.
double reproducible_sin(double angle_rad);
double reproducible_cos(double angle_rad);
/// Tangent of an angle in radians, relative error below 1e-15 away from the poles.
double reproducible_tan(double angle_rad);
/// Angle in radians, in (-pi/2, pi/2); relative error below 1e-15.
double reproducible_atan(double tangent);
/// Angle of the vector (x, y) in radians, in [-pi, pi]; 0 for the zero vector.
double reproducible_atan2(double y, double x);
/// angle_rad[k] = reproducible_atan2(y[k], x[k]), to the bit and faster; spans of one length.
void reproducible_atan2(std::span<const double> y, std::span<const double> x,
                        std::span<double> angle_rad);
/// Natural logarithm of x > 0 (-inf at 0, NaN below); absolute error below 4e-16 times max(1, |log
/// x|).
double reproducible_log(double x);
double reproducible_log2(double x);
/// e^x; relative error below 1e-15 times max(1, |x|).
double reproducible_exp(double x);
/// base^exponent for base >= 0.
double reproducible_pow(double base, double exponent);

}  // namespace plumb
