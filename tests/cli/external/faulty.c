/* Evaluators as they come while a kernel is being written: what lekalo must say of them. All are a saddle but for their
 * fault. */
#include <lekalo/external.h>
#include <math.h>
#include <stdlib.h>

LEKALO_SURFACE(good)
LEKALO_SURFACE(returns_7_at_some)
LEKALO_SURFACE(returns_7_at_one)
LEKALO_SURFACE(not_a_number)
LEKALO_SURFACE(forgets_duv)
LEKALO_SURFACE(takes_a_second_parameter)
LEKALO_SURFACE(wrong_in_the_ninth_digit)
LEKALO_SURFACE(wrong_dv)
LEKALO_SURFACE(has_an_edge)
LEKALO_SURFACE(points_only)
LEKALO_SURFACE(one_call_at_a_time)
LEKALO_SURFACE(constant)
LEKALO_SURFACE(exits_at_some)
LEKALO_SURFACE(exits_at_one)
LEKALO_SURFACE(crashes_at_one)
LEKALO_SURFACE(stuck_at_some)
LEKALO_SURFACE(stuck_at_one)
LEKALO_CURVE(aborts)
LEKALO_CURVE(wrong_second_derivative)

static void saddle(double u, double v, int order, double* out) {
  const double values[18] = {
      u, v, u * v + 0.2 * sin(3 * u), 1, 0, v + 0.6 * cos(3 * u), 0, 1, u, 0, 0, -1.8 * sin(3 * u), 0, 0, 1, 0, 0, 0};
  const int count = order == 0 ? 3 : order == 1 ? 9 : 18;
  for (int i = 0; i < count; ++i) out[i] = values[i];
}

int good(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  return 0;
}

int returns_7_at_some(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  return u > 0.7 && v > 0.6 ? 7 : 0;
}

int returns_7_at_one(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  return u == 0.123 ? 7 : 0;
}

int not_a_number(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  if (v == 1) out[2] = log(u - 1);
  return 0;
}

int forgets_duv(const double* parameters, double u, double v, int order, double* out) {
  double all[18];
  (void)parameters;
  saddle(u, v, order, all);
  for (int i = 0; i < (order + 1) * (order + 2) / 2 * 3; ++i)
    if (i / 3 != 4) out[i] = all[i];
  return 0;
}

int takes_a_second_parameter(const double* parameters, double u, double v, int order, double* out) {
  saddle(u, v, order, out);
  out[2] += parameters[1] * u;
  return 0;
}

int wrong_in_the_ninth_digit(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  out[0] += 3e-9 * u * u;
  return 0;
}

int wrong_dv(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  if (order >= 1) out[8] = 1.001 * u;
  return 0;
}

int has_an_edge(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  out[2] += fabs(u - 0.3);
  return 0;
}

int points_only(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  if (order > 0) return 1;
  saddle(u, v, 0, out);
  return 0;
}

/* Returns 9 if it is called while another call lasts. */
int one_call_at_a_time(const double* parameters, double u, double v, int order, double* out) {
  static int inside;
  const int others = __atomic_fetch_add(&inside, 1, __ATOMIC_SEQ_CST);
  (void)parameters;
  for (volatile int i = 0; i < 300; ++i) continue;
  saddle(u, v, order, out);
  __atomic_fetch_sub(&inside, 1, __ATOMIC_SEQ_CST);
  return others > 0 ? 9 : 0;
}

int constant(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters, (void)u, (void)v;
  saddle(0, 0, order, out);
  return 0;
}

int wrong_second_derivative(const double* parameters, double t, int order, double* out) {
  (void)parameters;
  const double values[9] = {cos(t), sin(t), t, -sin(t), cos(t), 1, cos(t), -sin(t), 0};
  for (int i = 0; i < 3 * (order + 1); ++i) out[i] = values[i];
  return 0;
}

int exits_at_some(const double* parameters, double u, double v, int order, double* out) {
  if (u > 0.7 && v > 0.6) exit(0);
  return good(parameters, u, v, order, out);
}

int exits_at_one(const double* parameters, double u, double v, int order, double* out) {
  if (u == 0.123) exit(0);
  return good(parameters, u, v, order, out);
}

int crashes_at_one(const double* parameters, double u, double v, int order, double* out) {
  if (u == 0.123) *(volatile double*)0 = v;
  return good(parameters, u, v, order, out);
}

int aborts(const double* parameters, double t, int order, double* out) {
  (void)parameters, (void)t, (void)order, (void)out;
  abort();
}

int stuck_at_some(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  for (volatile int spin = 1; spin && u > 0.7 && v > 0.6;) {
  }
  return 0;
}

int stuck_at_one(const double* parameters, double u, double v, int order, double* out) {
  (void)parameters;
  saddle(u, v, order, out);
  for (volatile int spin = 1; spin && u == 0.123;) {
  }
  return 0;
}
