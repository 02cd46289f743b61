// Triple: three coordinates of any number type (double, Interval, Jet, Jet2), for formulas that are written once and
// evaluated as numbers, derivatives and enclosures. Operands of different types mix where their numbers do: a Jet
// times a Triple<double> is a Triple of jets.
#pragma once

#include <cmath>
#include <type_traits>

namespace lekalo::geometry {

template <class T>
struct Triple {
  T x{}, y{}, z{};

  bool operator==(const Triple&) const = default;  // constexpr where T allows it
  template <class U>
  constexpr Triple& operator+=(const Triple<U>& b) {
    return *this = *this + b;
  }
  template <class U>
  constexpr Triple& operator-=(const Triple<U>& b) {
    return *this = *this - b;
  }
};

template <class T>
Triple(T, T, T) -> Triple<T>;

template <class T>
inline constexpr bool kIsTriple = false;
template <class T>
inline constexpr bool kIsTriple<Triple<T>> = true;

template <class T>
constexpr Triple<T> operator-(const Triple<T>& a) {
  return {-a.x, -a.y, -a.z};
}

template <class A, class B>
constexpr auto operator+(const Triple<A>& a, const Triple<B>& b) -> Triple<std::decay_t<decltype(a.x + b.x)>> {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class A, class B>
constexpr auto operator-(const Triple<A>& a, const Triple<B>& b) -> Triple<std::decay_t<decltype(a.x - b.x)>> {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class A, class B>
requires(!kIsTriple<A>) constexpr auto operator*(const A& s, const Triple<B>& b)
    -> Triple<std::decay_t<decltype(s * b.x)>> {
  return {s * b.x, s * b.y, s * b.z};
}

template <class A, class B>
requires(!kIsTriple<B>) constexpr auto operator*(const Triple<A>& a, const B& s)
    -> Triple<std::decay_t<decltype(a.x * s)>> {
  return {a.x * s, a.y * s, a.z * s};
}

template <class A, class B>
requires(!kIsTriple<B>) constexpr auto operator/(const Triple<A>& a, const B& s)
    -> Triple<std::decay_t<decltype(a.x / s)>> {
  return {a.x / s, a.y / s, a.z / s};
}

template <class A, class B>
constexpr auto dot(const Triple<A>& a, const Triple<B>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class A, class B>
constexpr auto cross(const Triple<A>& a, const Triple<B>& b) -> Triple<std::decay_t<decltype(a.y * b.z)>> {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

template <class T>
T length(const Triple<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

}  // namespace lekalo::geometry
