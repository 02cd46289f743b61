#include "geometry/expression/branches.h"

#include <algorithm>
#include <cmath>

#include "geometry/expression/operations.h"

namespace lekalo::geometry {

namespace {

constexpr size_t kMaxBranches = 256;
constexpr double kNoStep = 1e-9;  // of a step's height

bool is_step(Operation operation) {
  return operation == Operation::floor || operation == Operation::ceil || operation == Operation::round ||
         operation == Operation::mod;
}

}  // namespace

class ExpressionBrancher {
  using Instruction = Expression::Instruction;

 public:
  ExpressionBrancher(std::span<const Expression> formulas, std::span<const Interval> ranges)
      : formulas_(formulas), ranges_(ranges) {}

  std::optional<std::vector<ExpressionBranch>> run() {
    Choice given;
    for (const Expression& formula : formulas_) given.programs.push_back(formula.program_);
    std::vector<ExpressionBranch> branches;
    for (const Choice& steps : without_steps(given)) {
      std::vector<Choice> all{{{}, steps.sides}};
      for (const Program& program : steps.programs)
        all = combined(all, value_of(program).choices, [](const Choice& a, const Choice& b, Choice& both) {
          both.programs = a.programs;
          both.programs.push_back(b.programs[0]);
        });
      if (too_many_ || branches.size() + all.size() > kMaxBranches) return std::nullopt;
      for (const Choice& choice : all) {
        ExpressionBranch& branch = branches.emplace_back();
        for (const Program& program : choice.programs) branch.formulas.push_back(expression(program));
        for (const Side& side : choice.sides) branch.sides.push_back({expression(side.height), side.positive});
      }
    }
    return branches;
  }

  static bool have_steps(const Expression& formula) {
    return std::any_of(formula.program_.begin(), formula.program_.end(), [](const Instruction& in) {
      const auto operation = static_cast<Operation>(in.operation);
      return is_step(operation) || operation == Operation::sign || operation == Operation::select;
    });
  }

 private:
  using Program = std::vector<Instruction>;
  // `of` is what there was to choose between; of steps what they round, whose border is where the height vanishes.
  struct Side {
    Program of, height;
    bool positive;
    double border = 0;
  };
  // What is left of formulas where sides are chosen.
  struct Choice {
    std::vector<Program> programs;
    std::vector<Side> sides;
  };
  // Of a condition the whole is a height that is not negative where it holds.
  struct Value {
    Program whole;
    std::vector<Choice> choices;
  };

  Expression expression(const Program& program) const {
    Expression result = formulas_[0];
    result.program_ = program;
    result.compile();
    return result;
  }
  static bool is_constant(const Program& program) {
    return std::none_of(program.begin(), program.end(), [](const Instruction& in) {
      return static_cast<Operation>(in.operation) == Operation::variable;
    });
  }
  double value(const Program& constant) const { return expression(constant)(); }

  static bool same(const Program& a, const Program& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Instruction& x, const Instruction& y) {
      return x.operation == y.operation && x.index == y.index && x.value == y.value;
    });
  }
  static Program made(Operation operation, std::initializer_list<const Program*> operands, int index = 0) {
    Program program;
    for (const Program* operand : operands) program.insert(program.end(), operand->begin(), operand->end());
    program.push_back({static_cast<std::uint8_t>(operation), 0, index, 0});
    return program;
  }
  static Program number(double value) { return {{static_cast<std::uint8_t>(Operation::literal), 0, 0, value}}; }

  // False where the side is another one than was chosen before.
  static bool choose(std::vector<Side>& sides, const Side& side) {
    bool known = false;
    for (const Side& one : sides) {
      if (!same(one.of, side.of)) continue;
      if (one.positive != side.positive && (one.positive ? one : side).border >= (one.positive ? side : one).border)
        return false;
      known = known || same(one.height, side.height);
    }
    if (!known) sides.push_back(side);
    return true;
  }

  template <class Put>
  std::vector<Choice> combined(const std::vector<Choice>& a, const std::vector<Choice>& b, const Put& put) {
    std::vector<Choice> all;
    for (const Choice& one : a)
      for (const Choice& other : b) {
        Choice both;
        both.sides = one.sides;
        if (!std::all_of(other.sides.begin(), other.sides.end(),
                         [&](const Side& side) { return choose(both.sides, side); }))
          continue;
        put(one, other, both);
        all.push_back(std::move(both));
        if (all.size() > kMaxBranches) {
          too_many_ = true;
          return all;
        }
      }
    return all;
  }

  void add_side(Choice choice, const Program& of, const Program& height, bool positive, std::vector<Choice>& choices) {
    if (is_constant(height) ? (value(height) >= 0) == positive : choose(choice.sides, {of, height, positive}))
      choices.push_back(std::move(choice));
    too_many_ = too_many_ || choices.size() > kMaxBranches;
  }

  // Where the program of the last operand before `end` begins.
  static size_t operand_begin(const Program& program, size_t end) {
    for (int missing = 1; missing > 0;) missing += operand_count(static_cast<Operation>(program[--end].operation)) - 1;
    return end;
  }
  static Program part(const Program& program, size_t begin, size_t end) {
    return {program.begin() + static_cast<std::ptrdiff_t>(begin), program.begin() + static_cast<std::ptrdiff_t>(end)};
  }
  static Program replaced(Program program, const Program& old, const Program& now) {
    for (size_t at = program.size() + 1; at-- > old.size();)
      if (const size_t begin = at - old.size(); same(part(program, begin, at), old)) {
        program.erase(program.begin() + static_cast<std::ptrdiff_t>(begin),
                      program.begin() + static_cast<std::ptrdiff_t>(at));
        program.insert(program.begin() + static_cast<std::ptrdiff_t>(begin), now.begin(), now.end());
        at = std::min(at, program.size() + 1);
      }
    return program;
  }

  // The formulas for each value of their steps, the innermost first; as they are where one has too many.
  std::vector<Choice> without_steps(const Choice& given) {
    std::vector<Choice> waiting{given}, done;
    while (!waiting.empty()) {
      const Choice choice = std::move(waiting.back());
      waiting.pop_back();
      const std::optional<Program> step = first_step(choice.programs);
      if (!step)
        done.push_back(choice);
      else if (!add_steps(choice, *step, waiting) || waiting.size() + done.size() > kMaxBranches)
        return {given};
    }
    return done;
  }
  static std::optional<Program> first_step(const std::vector<Program>& programs) {
    for (const Program& program : programs)
      for (size_t i = 0; i < program.size(); ++i)
        if (is_step(static_cast<Operation>(program[i].operation)))
          return part(program, operand_begin(program, i + 1), i + 1);
    return std::nullopt;
  }
  // A step has the value n for n + shift <= q <= n + 1 + shift.
  bool add_steps(const Choice& choice, const Program& step, std::vector<Choice>& choices) const {
    const auto operation = static_cast<Operation>(step.back().operation);
    const bool is_mod = operation == Operation::mod;
    const double shift = operation == Operation::ceil ? -1 : operation == Operation::round ? -0.5 : 0;
    const size_t end = step.size() - 1, second = operand_begin(step, end);
    const Program a = part(step, 0, is_mod ? second : end), b = part(step, second, end);
    const Program q = is_mod ? made(Operation::divide, {&a, &b}) : a;
    if (ranges_.empty()) return false;
    const Interval range = expression(q).evaluate(ranges_);
    if (!(range.width() <= kMaxBranches)) return false;
    // A step that begins where the range ends is one no more.
    const double first = std::floor(range.lo - shift + kNoStep),
                 last = std::max(first, std::ceil(range.hi - shift - kNoStep) - 1);
    for (double n = first; n <= last; ++n) {
      Choice one = choice;
      Program value = number(n);
      if (is_mod) {
        const Program multiple = made(Operation::multiply, {&b, &value});
        value = made(Operation::subtract, {&a, &multiple});
      }
      const auto is_beside = [&](double border, bool positive) {
        const Program at = number(border);
        return choose(one.sides, {q, made(Operation::subtract, {&q, &at}), positive, border});
      };
      if ((n != first && !is_beside(n + shift, true)) || (n != last && !is_beside(n + 1 + shift, false))) continue;
      for (Program& program : one.programs) program = replaced(std::move(program), step, value);
      choices.push_back(std::move(one));
    }
    return true;
  }

  Value value_of(const Program& program) {
    std::vector<Value> stack;
    for (const Instruction& in : program) {
      if (too_many_) break;
      const auto operation = static_cast<Operation>(in.operation);
      const size_t count = static_cast<size_t>(operand_count(operation));
      std::vector<Value> operands(std::make_move_iterator(stack.end() - count), std::make_move_iterator(stack.end()));
      stack.resize(stack.size() - count);
      stack.push_back(applied(in, operands));
    }
    if (too_many_) return {};
    return std::move(stack.back());
  }

  Value applied(const Instruction& in, std::vector<Value>& operands) {
    const auto operation = static_cast<Operation>(in.operation);
    Value result;
    result.whole = whole_of(in, operands);
    std::vector<Choice>& choices = result.choices;
    switch (operation) {
      case Operation::abs:
      case Operation::sign:
        for (const Choice& a : operands[0].choices)
          for (const bool positive : {true, false}) {
            Choice one = a;
            if (operation == Operation::sign && is_constant(a.programs[0]))
              one.programs = {made(operation, {&a.programs[0]})};
            else if (operation == Operation::sign)
              one.programs = {number(positive ? 1 : -1)};
            else if (!positive)
              one.programs = {made(Operation::negate, {&a.programs[0]})};
            add_side(std::move(one), result.whole, a.programs[0], positive, choices);
          }
        return result;
      case Operation::min:
      case Operation::max:
        for (const bool first : {true, false})
          for (const Choice& one : operands[first ? 0 : 1].choices) {
            const Program height = first ? made(Operation::subtract, {&one.programs[0], &operands[1].whole})
                                         : made(Operation::subtract, {&operands[0].whole, &one.programs[0]});
            add_side(one, result.whole, height, first == (operation == Operation::max), choices);
          }
        return result;
      case Operation::clamp: {
        std::vector<Value> inner{operands[0], operands[1]};
        std::vector<Value> outer{applied(instruction(Operation::max), inner), operands[2]};
        return applied(instruction(Operation::min), outer);
      }
      case Operation::select:
        for (const bool first : {true, false})
          for (const Choice& one : operands[first ? 0 : 2].choices)
            add_side(one, result.whole, operands[1].whole, first, choices);
        return result;
      case Operation::less:
      case Operation::less_equal:
      case Operation::greater:
      case Operation::greater_equal:
      case Operation::equal:
      case Operation::unequal:
      case Operation::logical_and:
      case Operation::logical_or:
      case Operation::logical_not:
        return result;  // what is chosen by it asks for its height alone
      default:
        break;
    }
    choices = {{{Program()}, {}}};
    for (const Value& operand : operands)
      choices = combined(choices, operand.choices, [](const Choice& a, const Choice& b, Choice& both) {
        both.programs = a.programs;
        both.programs[0].insert(both.programs[0].end(), b.programs[0].begin(), b.programs[0].end());
      });
    for (Choice& choice : choices) choice.programs[0].push_back(in);
    return result;
  }

  static Instruction instruction(Operation operation) { return {static_cast<std::uint8_t>(operation), 0, 0, 0}; }

  Program whole_of(const Instruction& in, const std::vector<Value>& operands) const {
    const auto operation = static_cast<Operation>(in.operation);
    const bool compares = operation == Operation::equal || operation == Operation::unequal ||
                          operation == Operation::less || operation == Operation::less_equal ||
                          operation == Operation::greater || operation == Operation::greater_equal;
    if (compares && is_constant(operands[0].whole) && is_constant(operands[1].whole))
      return number(value(made(operation, {&operands[0].whole, &operands[1].whole})) != 0 ? 1 : -1);
    switch (operation) {
      case Operation::less:
      case Operation::less_equal:
        return made(Operation::subtract, {&operands[1].whole, &operands[0].whole});
      case Operation::greater:
      case Operation::greater_equal:
        return made(Operation::subtract, {&operands[0].whole, &operands[1].whole});
      case Operation::equal:  // holds on no more than a border
        return number(-1);
      case Operation::unequal:
        return number(1);
      case Operation::logical_and:
      case Operation::logical_or:
        for (const int k : {0, 1})
          if (const Program& known = operands[k].whole, &other = operands[1 - k].whole; is_constant(known))
            return (value(known) >= 0) == (operation == Operation::logical_and) ? other : known;
        return made(operation == Operation::logical_and ? Operation::min : Operation::max,
                    {&operands[0].whole, &operands[1].whole});
      case Operation::logical_not:
        return made(Operation::negate, {&operands[0].whole});
      case Operation::select: {  // with the condition as it is computed
        const Program zero = number(0), holds = made(Operation::greater_equal, {&operands[1].whole, &zero});
        return made(Operation::select, {&operands[0].whole, &holds, &operands[2].whole});
      }
      default:
        break;
    }
    Program program;
    for (const Value& operand : operands) program.insert(program.end(), operand.whole.begin(), operand.whole.end());
    program.push_back(in);
    return program;
  }

  const std::span<const Expression> formulas_;
  const std::span<const Interval> ranges_;
  bool too_many_ = false;
};

std::optional<std::vector<ExpressionBranch>> expression_branches(std::span<const Expression> formulas,
                                                                 std::span<const Interval> ranges) {
  return ExpressionBrancher(formulas, ranges).run();
}

bool have_steps(std::span<const Expression> formulas) {
  return std::any_of(formulas.begin(), formulas.end(), ExpressionBrancher::have_steps);
}

}  // namespace lekalo::geometry
