"""The section `constraints`: what is found, what is refused and what is said of it."""

import resource
import unittest

from program import SCENE_ERROR, ProgramTest


class Constraints(ProgramTest):
    def scene(self, conditions, rest=""):
        lines = "".join(f"    - {one}\n" for one in conditions)
        return self.write("scene.yaml", f"lekalo: 1\nconstraints:\n{rest}  conditions:\n{lines}")

    def solved(self, conditions, **unknowns):
        """Of variables with these starts, formulas as conditions."""
        variables = ", ".join(f"{{name: {name}, start: {start}}}" for name, start in unknowns.items())
        equations = [f"{{type: equation, is: '{one}'}}" for one in conditions]
        return self.json_of("solve", self.scene(equations, f"  variables: [{variables}]\n"))

    def test_the_change_is_least_among_its_neighbours(self):
        for a, b, least in (0.1, 2, 0.756703222589612), (0, 2, 0.875):
            self.assert_near(self.solved(["b = a^2"], a=a, b=b)["change"], least, 1e-8)

    def test_inequalities_that_hold_together_are_met(self):
        self.assert_near(self.solved(["10*a >= 10", "a >= 2"], a=0)["variables"]["a"], 2, 1e-12)
        self.assert_near(self.solved(["10*a >= 10", "b >= a", "a >= 2"], a=0, b=0)["variables"]["b"], 2, 1e-12)
        found = self.solved(["a >= 1", "b + a >= 3", "2*a + b >= 5", "b >= 3"], a=0, b=0)["variables"]
        self.assert_near([found["a"], found["b"]], [1, 3], 1e-12)

    def test_a_start_without_slope_is_no_contradiction(self):
        self.assert_near(self.solved(["a^2 + b^2 = 4"], a=0, b=0)["change"], 2, 1e-9)
        points = "  points: [{name: a, at: [0, 0]}, {name: b, at: [1, 0]}, {name: c, at: [1, 0]}, {name: d, at: [2, 0]}]\n"
        fixed = [f"{{type: fixed, of: {name}}}" for name in "abc"]
        found = self.json_of("solve", self.scene(fixed + ["{type: perpendicular, of: [a, b, c, d]}"], points))
        self.assert_near(found["points"]["d"][0], 1, 1e-9)
        self.scene(["{type: equation, is: 'a^2 = -1'}"], "  variables: [{name: a, start: 0}]\n")
        self.assertIn("the conditions contradict each other", self.run_program("solve", "scene.yaml", code=SCENE_ERROR)[1])

    def test_rounding_of_large_numbers_counts_as_met(self):
        self.assert_near(self.solved(["a*a = 2000000"], a=1000)["variables"]["a"], 2e6**0.5, 1e-9)
        points = ("  points: [{name: p, at: [500000, 4000000]}, {name: q, at: [500001, 4000000.2]}, "
                  "{name: r, at: [500001, 4000001]}]\n")
        found = self.json_of("solve", self.scene(
            ["{type: fixed, of: p}", "{type: distance, between: [p, q], value: 2}", "{type: angle, of: [q, p, r], angle: 30}",
             "{type: equal_length, of: [p, q, p, r]}"], points))["points"]
        sides = [[b - a for a, b in zip(found["p"], found[name])] for name in "qr"]
        self.assert_near([sum(x * x for x in side) for side in sides], [4, 4], 1e-8)
        self.assert_near(sum(a * b for a, b in zip(*sides)), 2 * 3**0.5, 1e-8)

    def test_parallel_segments_are_so_in_space(self):
        points = "  points: [{name: a, at: [0, 0, 0]}, {name: b, at: [1, 0, 1]}, {name: c, at: [0, 1, 0]}, {name: d, at: [1, 1.2, 2]}]\n"
        found = self.json_of("solve", self.scene(["{type: parallel, of: [a, b, c, d]}"], points))["points"]
        first, second = ([b - a for a, b in zip(found[p], found[q])] for p, q in ("ab", "cd"))
        self.assert_near([2 * x for x in first], second, 1e-9)
        points = points.replace("[1, 0, 1]", "[1, 0, 0]")
        said = self.run_program("solve", self.scene(["{type: parallel, of: [a, b, c, d]}"], points), code=SCENE_ERROR)[1]
        self.assertIn("the conditions contradict each other", said)

    def test_what_an_inequality_holds_is_not_free(self):
        found = self.solved(["a >= 2", "b = 1"], a=0, b=0)
        self.assertEqual((found["freedom"], found["free"]), (0, []))
        self.assertEqual(self.solved(["a >= 2", "b = 1"], a=3, b=0)["free"], ["a"])

    def test_a_long_chain_is_solved_soon(self):
        names = [f"p{k}" for k in range(60)]
        points = ", ".join(f"{{name: {name}, at: [{k}, {0.1 * (k % 3)}]}}" for k, name in enumerate(names))
        links = [f"{{type: distance, between: [{a}, {b}], value: 1.05}}" for a, b in zip(names, names[1:])]
        before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        found = self.json_of("solve", self.scene(["{type: fixed, of: p0}"] + links, f"  points: [{points}]\n"))
        self.assertLess(resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before, 1.5)  # it was 2.7
        self.assertEqual(found["freedom"], 59)

    def test_the_graph_tells_blocks_and_rigid_parts(self):
        points = "  points: [{name: a, at: [0, 0]}, {name: b, at: [1.1, 0]}, {name: c, at: [0.4, 0.8]}, {name: d, at: [2, 1]}]\n"
        sides = [f"{{type: distance, between: [{x}, {y}], value: 1, name: {x}{y}}}" for x, y in ("ab", "bc", "ca", "bd")]
        said = self.run_program("solve", self.scene(["{type: fixed, of: a}", "{type: horizontal, between: [a, b]}"] + sides, points),
                                "--graph")[0]
        for line in ("blocks, the largest of 2 unknowns, solved one after another", "well  b_x <- ab", "well  c_x, c_y <- bc, ca",
                     "under d_x, d_y <- bd", "rigid by count of distances: a, b, c", "rigid by rank: a, b, c"):
            self.assertIn(line, said)
        # A triangle on two fixed points that contradict its side: more equations than unknowns.
        fixed = ["{type: fixed, of: a}", "{type: fixed, of: b}", "{type: distance, between: [a, b], value: 1.1}"]
        found = self.json_of("solve", self.scene(fixed, points), "--graph")
        self.assertEqual(found["graph"]["blocks"][0]["part"], "over")
        self.assertEqual(found["redundant"], 1)

    def test_inequalities_go_with_blocks_while_they_hold(self):
        for bound, by_blocks in (("a >= 1", True), ("a >= 2.5", False)):
            scene = self.scene([f"{{type: equation, is: '{one}'}}" for one in ("b = a + 1", "c = 3", bound)],
                               "  variables: [{name: a, start: 2}, {name: b, start: 3}, {name: c, start: 0}]\n")
            found = self.json_of("solve", scene, "--graph")
            self.assertEqual(found["graph"]["solved_by_blocks"], by_blocks)
            self.assert_near([found["variables"][x] for x in "abc"], [2, 3, 3] if by_blocks else [2.5, 3.5, 3], 1e-12)

    def test_names_are_names_and_mean_one_thing(self):
        for unknowns, message in (
                ("points: [{name: p, at: [0, 0]}]\n  variables: [{name: p_x, start: 1}]", "'p_x' is a coordinate of 'p'"),
                ("points: [{name: p, at: [0, 0]}]\n  variables: [{name: rr, start: 1}]", "there is a parameter 'rr'"),
                ("points: [{name: q, at: [0, 0]}]", "'q_y' is a coordinate of 'q'"),
                ("points: [{name: 'a b', at: [0, 0]}]", "cannot be part of a name"),
                ("points: [{name: '', at: [0, 0]}]", "a name is empty"),
                ("bodies: [{name: q.1}]", "cannot be part of a name")):
            scene = self.scene(["{type: equation, is: 'rr = 3'}"], f"  {unknowns}\n")
            self.write(scene, (self.folder / scene).read_text() + "parameters: {rr: 3, q_y: 1}\n")
            self.assertIn(message, self.run_program("solve", scene, code=SCENE_ERROR)[1])

    def test_to_use_what_is_not_found_is_no_mistake_of_its_own(self):
        unknowns = ("  points: [{name: p, at: [0, 0]}, {name: q, at: [1, 0.3]}]\n  bodies: {name: arm}\n"
                    "  variables: {name: rr, start: 1}\n  on_curves: {name: c, of: {type: circle, radius: 1}, t: 0}\n")
        for condition, message in (("type: equation, is: 'rr^2 = -1'", "contradict each other"),
                                   ("type: fixed, of: s", "no point 's'"), ("type: tangent, of: p", "'tangent'")):
            scene = self.scene([f"{{{condition}}}"], unknowns)
            self.write(scene, (self.folder / scene).read_text() + "geometry:\n  a: {type: polyline, points: [p, q, c]}\n"
                       "  b: {type: circle, radius: rr/4, transform: {pose: arm}}\n")
            said = self.run_program("check", scene, code=SCENE_ERROR)[1]
            self.assertIn(message, said)
            self.assertEqual(said.count("scene.yaml:"), 1, said)
        # Another mistake is told in the same run.
        self.write(scene, (self.folder / scene).read_text() + "  d: {type: circle, radius: s}\n")
        self.assertEqual(self.run_program("check", scene, code=SCENE_ERROR)[1].count("scene.yaml:"), 2)

    def test_a_field_of_another_condition_is_refused(self):
        points = "  points: [{name: p, at: [0, 0]}, {name: q, at: [1, 0.3]}]\n"
        for condition, message in (("type: horizontal, between: [p, q], value: 2", "'horizontal' takes no 'value'"),
                                   ("type: distance, between: [p, q], value: 2, along: y", "'distance' takes no 'along'"),
                                   ("type: fixed, of: p, value: 7", "'p' is no variable")):
            scene = self.scene([f"{{{condition}}}"], points)
            self.assertIn(message, self.run_program("solve", scene, code=SCENE_ERROR)[1])

    def test_a_scene_has_one_system_of_constraints(self):
        part = "lekalo: 1\nconstraints: {points: [{name: NAME, at: [3, 3]}], conditions: [{type: fixed, of: NAME}]}\n"
        self.write("a.yaml", part.replace("NAME", "p")), self.write("b.yaml", part.replace("NAME", "q"))
        self.write("once.yaml", "lekalo: 1\ninclude: a.yaml\n")
        self.assertEqual(self.json_of("solve", "once.yaml")["points"], {"p": [3, 3, 0]})
        self.write("both.yaml", "lekalo: 1\ninclude: [a.yaml, b.yaml]\n")
        self.assertIn("a second section 'constraints'", self.run_program("solve", "both.yaml", code=SCENE_ERROR)[1])
        self.write("over.yaml", part.replace("NAME", "r") + "include: a.yaml\n")
        self.assertIn("a second section 'constraints'", self.run_program("solve", "over.yaml", code=SCENE_ERROR)[1])
        self.write("as.yaml", "lekalo: 1\ninclude: {file: a.yaml, as: left}\n")
        self.assertIn("included as 'left' has 'constraints'", self.run_program("solve", "as.yaml", code=SCENE_ERROR)[1])


if __name__ == "__main__":
    unittest.main()
