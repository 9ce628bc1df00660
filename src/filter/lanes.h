// Eight neighbouring taxels at once: what the kernels of the spatial filters are written in. Two
// vectors of four, which every machine of interest has.
#pragma once

#include <cstring>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

namespace palpate::detail {

inline constexpr int kLanes = 8;
inline constexpr int kFour = 4;
typedef float FourLanes __attribute__((vector_size(16)));  // NOLINT: an attribute of GCC and clang

inline FourLanes least(FourLanes a, FourLanes b) {
#if defined(__SSE__)
  return _mm_min_ps(a, b);
#else
  return a < b ? a : b;
#endif
}
inline FourLanes most(FourLanes a, FourLanes b) {
#if defined(__SSE__)
  return _mm_max_ps(a, b);
#else
  return a > b ? a : b;
#endif
}

// x <= y afterwards.
inline void order(FourLanes& x, FourLanes& y) {
  const FourLanes small = least(x, y);
  y = most(x, y);
  x = small;
}
inline FourLanes middle(FourLanes x, FourLanes y, FourLanes z) {
  return most(least(x, y), least(most(x, y), z));
}
inline FourLanes loadFour(const float* from) {
  FourLanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
inline void store(float* to, FourLanes lanes) { std::memcpy(to, &lanes, sizeof lanes); }

struct Lanes {
  FourLanes a{};
  FourLanes b{};
};

inline Lanes all(float value) { return {FourLanes{} + value, FourLanes{} + value}; }
inline Lanes load(const float* from) { return {loadFour(from), loadFour(from + 4)}; }
inline void store(float* to, const Lanes& lanes) {
  store(to, lanes.a);
  store(to + 4, lanes.b);
}
inline Lanes operator+(const Lanes& x, const Lanes& y) { return {x.a + y.a, x.b + y.b}; }
inline Lanes operator-(const Lanes& x, const Lanes& y) { return {x.a - y.a, x.b - y.b}; }
inline Lanes operator*(const Lanes& x, const Lanes& y) { return {x.a * y.a, x.b * y.b}; }
inline Lanes operator/(const Lanes& x, const Lanes& y) { return {x.a / y.a, x.b / y.b}; }
inline Lanes least(const Lanes& x, const Lanes& y) { return {least(x.a, y.a), least(x.b, y.b)}; }
inline Lanes most(const Lanes& x, const Lanes& y) { return {most(x.a, y.a), most(x.b, y.b)}; }

}  // namespace palpate::detail
