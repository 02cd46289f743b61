// Numbers that tell shells apart, whatever their sizes (Golovanov 2016, 5.2 to 5.4).
#pragma once

#include <optional>
#include <vector>

#include "geometry/body.h"

namespace lekalo::geometry {

// What a shell is made of, pole edges left out. A connected shell with the Euler number H = F - E + V + (F - L):
// connectivity 3 - H of a closed one (2 - H of an open one), and genus 1 - H/2 of a closed one with two sides.
struct ShellCharacteristics {
  int faces = 0, edges = 0, vertices = 0, loops = 0;
  int euler_characteristic = 0;
  int borders = 0;         // closed chains of edges that belong to one face only
  bool orientable = true;  // faces can be turned so that neighbours look to one side
  bool manifold = true;    // at most two faces meet in an edge, and those around a vertex form one fan
  int connectivity = 0;    // 0 where the shell is not manifold
  std::optional<int> genus;
  std::optional<double> volume;  // of a closed shell: positive for an outer one, negative for an inner one
};

// Of each connected part of the body, by its lowest face: faces are connected by edges.
std::vector<ShellCharacteristics> characteristics(const Body& body);

// Gives each connected part of the body, by its lowest face, a shell.
void divide_shells(Body& body);

// Edges in which more than two faces meet, and vertices whose faces form several fans, by number.
struct NonManifold {
  std::vector<int> edges, vertices;
};
NonManifold non_manifold_places(const Body& body);

}  // namespace lekalo::geometry
