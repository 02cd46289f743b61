// Divided differences (Golovanov 2016, 2.7; Zavyalov et al. 1985, I.1).
//
//   f[t_i] = f(t_i),  f[t_0..t_m] = (f[t_1..t_m] - f[t_0..t_{m-1}]) / (t_m - t_0),
//   f[t_i, .., t_i] (m + 1 times) = f^(m)(t_i) / m!
#pragma once

#include <cstddef>
#include <vector>

namespace lekalo::geometry {

// The coefficients f[t_0], f[t_0, t_1], .., f[t_0..t_n] of Newton's interpolating polynomial
// sum_k f[t_0..t_k] (t - t_0) .. (t - t_{k-1}). Equal nodes stand side by side; values[i] is f of the first of them,
// f' of the second, f'' of the third, ... One more node adds one coefficient and leaves the others.
template <class Real, class Value>
std::vector<Value> divided_differences(const std::vector<Real>& nodes, const std::vector<Value>& values) {
  const std::size_t count = nodes.size();
  std::vector<std::size_t> first(count, 0);  // of the nodes equal to each
  for (std::size_t i = 1; i < count; ++i) first[i] = nodes[i] == nodes[i - 1] ? first[i - 1] : i;
  std::vector<Value> row(count), result;
  for (std::size_t i = 0; i < count; ++i) row[i] = values[first[i]];
  Real factorial = 1;
  for (std::size_t m = 0; m < count; ++m) {
    result.push_back(row[0]);
    factorial *= static_cast<Real>(m + 1);
    for (std::size_t i = 0; i + m + 1 < count; ++i)
      row[i] = first[i + m + 1] == first[i] ? values[first[i] + m + 1] / factorial
                                            : (row[i + 1] - row[i]) / (nodes[i + m + 1] - nodes[i]);
  }
  return result;
}

}  // namespace lekalo::geometry
