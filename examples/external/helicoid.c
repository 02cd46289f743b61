/* A curve and a surface for lekalo, as a geometry kernel would offer its own: a helix and the helicoid between the axis
 * and it, each with its exact derivatives up to order 2.
 *
 *   cc -std=c99 -O2 -fPIC -shared -o libhelicoid.so helicoid.c -lm      (-I PREFIX/include for lekalo/external.h)
 *   lekalo measure kernel.yaml theirs --against ours --allow-external
 */
#include <lekalo/external.h>
#include <math.h>

enum { TOO_HIGH = 1 };

LEKALO_CURVE(helix)
LEKALO_SURFACE(helicoid)

static void put(double* out, double x, double y, double z) {
  out[0] = x;
  out[1] = y;
  out[2] = z;
}

/* parameters: radius, rise in one radian */
int helix(const double* parameters, double t, int order, double* out) {
  const double radius = parameters[0], rise = parameters[1];
  if (order > 2) return TOO_HIGH;
  put(out, radius * cos(t), radius * sin(t), rise * t);
  if (order >= 1) put(out + 3, -radius * sin(t), radius * cos(t), rise);
  if (order >= 2) put(out + 6, -radius * cos(t), -radius * sin(t), 0);
  return 0;
}

/* r(u, v) = (u cos v, u sin v, rise v); parameters: rise in one radian */
int helicoid(const double* parameters, double u, double v, int order, double* out) {
  const double rise = parameters[0], c = cos(v), s = sin(v);
  if (order > 2) return TOO_HIGH;
  put(out, u * c, u * s, rise * v);
  if (order >= 1) {
    put(out + 3, c, s, 0);
    put(out + 6, -u * s, u * c, rise);
  }
  if (order >= 2) {
    put(out + 9, 0, 0, 0);
    put(out + 12, -s, c, 0);
    put(out + 15, -u * c, -u * s, 0);
  }
  return 0;
}
