#include "geometry/expression/branches.h"

#include <algorithm>

#include "geometry/expression/operations.h"

namespace lekalo::geometry {

namespace {

constexpr size_t kMostBranches = 256;

}  // namespace

class ExpressionBrancher {
 public:
  std::optional<std::vector<ExpressionBranch>> run(std::span<const Expression> formulas) {
    std::vector<Choice> all{{}};
    for (const Expression& formula : formulas) {
      const Value value = value_of(formula.program_);
      all = combined(all, value.choices, [](const Choice& a, const Choice& b, Choice& both) {
        both.programs = a.programs;
        both.programs.push_back(b.programs[0]);
      });
    }
    if (too_many_) return std::nullopt;
    const auto expression = [&](const Program& program) {
      Expression result = formulas[0];
      result.program_ = program;
      result.compile();
      return result;
    };
    std::vector<ExpressionBranch> branches;
    for (const Choice& choice : all) {
      ExpressionBranch& branch = branches.emplace_back();
      for (const Program& program : choice.programs) branch.formulas.push_back(expression(program));
      for (const Side& side : choice.sides) branch.sides.push_back({expression(side.height), side.positive});
    }
    return branches;
  }

 private:
  using Instruction = Expression::Instruction;
  using Program = std::vector<Instruction>;
  // `of` is what there was to choose between.
  struct Side {
    Program of, height;
    bool positive;
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
      if (one.positive != side.positive) return false;
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
        if (all.size() > kMostBranches) {
          too_many_ = true;
          return all;
        }
      }
    return all;
  }

  void add_side(Choice choice, const Program& of, const Program& height, bool positive, std::vector<Choice>& choices) {
    if (choose(choice.sides, {of, height, positive})) choices.push_back(std::move(choice));
    too_many_ = too_many_ || choices.size() > kMostBranches;
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
            if (operation == Operation::sign)
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

  static Program whole_of(const Instruction& in, const std::vector<Value>& operands) {
    switch (static_cast<Operation>(in.operation)) {
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
        return made(Operation::min, {&operands[0].whole, &operands[1].whole});
      case Operation::logical_or:
        return made(Operation::max, {&operands[0].whole, &operands[1].whole});
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

  bool too_many_ = false;
};

std::optional<std::vector<ExpressionBranch>> expression_branches(std::span<const Expression> formulas) {
  return ExpressionBrancher().run(formulas);
}

}  // namespace lekalo::geometry
