/* Functions that lekalo calls in shared libraries: curves and surfaces of other programs, shown and checked by
 * `type: external_curve` and `type: external_surface` of scene files. Plain C; nothing needs to be linked.
 *
 *   #include <lekalo/external.h>
 *
 *   int bump(const double* parameters, double u, double v, int order, double* out) {
 *     ...
 *     return 0;
 *   }
 *   LEKALO_SURFACE(bump)  // lets the compiler check the declaration
 *
 *   cc -O2 -fPIC -shared -o bump.so bump.c -lm
 */
#ifndef LEKALO_EXTERNAL_H
#define LEKALO_EXTERNAL_H

#ifdef __cplusplus
extern "C" {
#endif

/* The point and the derivatives of a surface at (u, v), by total order, in each order from u to v, three coordinates
 * each:
 *
 *   order 0   out[0..2]    r
 *   order 1   out[3..8]    r_u, r_v
 *   order 2   out[9..17]   r_uu, r_uv, r_vv
 *   order 3   out[18..29]  r_uuu, r_uuv, r_uvv, r_vvv
 *   order 4   out[30..44]  ...
 *
 * In other words: the derivative i times by u and j times by v begins at out[3 * ((i + j) * (i + j + 1) / 2 + j)].
 *
 *   parameters   the numbers of the scene's field `parameters`; a NaN stands behind the last, so that a function that
 *                takes more than it was given is found out. Valid during the call only.
 *   u, v         inside the domain of the scene
 *   order        0 to the scene's field `order`: all derivatives up to this one are wanted
 *   out          room for 3 (order + 1) (order + 2) / 2 numbers
 *
 * Returns 0, or any other number that says what is wrong: lekalo prints it with u and v and ends. Where the function
 * crashes lekalo crashes; a program (the scene's field `command`) would be apart from it.
 *
 * Calls come from several threads, one at a time for each library file; with `threads: safe` in the scene several at
 * once. A function may be called any number of times at the same place, and must give the same numbers. */
typedef int lekalo_surface(const double* parameters, double u, double v, int order, double* out);

/* The same for a curve at t: r, r', r'', ...; the derivative k begins at out[3 * k], room for 3 (order + 1) numbers. */
typedef int lekalo_curve(const double* parameters, double t, int order, double* out);

#ifdef __cplusplus
}
#define LEKALO_EXTERN extern "C"
#else
#define LEKALO_EXTERN extern
#endif

/* Declares functions of these types under their plain names, visible outside the library. */
#define LEKALO_SURFACE(name) LEKALO_EXTERN __attribute__((visibility("default"))) lekalo_surface name;
#define LEKALO_CURVE(name) LEKALO_EXTERN __attribute__((visibility("default"))) lekalo_curve name;

#endif
