// Programs that evaluate line by line: large batches, programs that talk too much, hang or end.
#include "render/external/process.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "geometry/describe.h"

namespace lekalo::render::process_test {
namespace {

using geometry::ExternalError;

std::shared_ptr<const geometry::ExternalFunction> python(const std::string& text, double timeout = 20) {
  return start_evaluator({"python3", "-c", text}, 2, timeout);
}

const std::string kPlane = "import sys\nfor line in sys.stdin:\n  u, v, order = line.split()\n  ";

std::vector<double> places(int count) {
  std::vector<double> result;
  for (int i = 0; i < count; ++i) {
    result.push_back(i / 7.0);
    result.push_back(-i / 3.0);
  }
  return result;
}

std::string complaint(const geometry::ExternalFunction& function) {
  std::vector<double> values(3);
  try {
    function.evaluate(places(1), 0, values);
  } catch (const ExternalError& error) {
    return error.what();
  }
  return {};
}

TEST(Process, LargeBatchesComeBackExactly) {
  const auto function = python(kPlane + "print(u, v, order, *[7] * 15, flush=True)");
  constexpr int kCount = 20000;
  const std::vector<double> uv = places(kCount);
  std::vector<double> values(18 * kCount);
  function->evaluate(uv, 2, values);
  for (int i = 0; i < kCount; ++i) {
    ASSERT_EQ(values[18 * i], uv[2 * i]);
    ASSERT_EQ(values[18 * i + 1], uv[2 * i + 1]);
    ASSERT_EQ(values[18 * i + 2], 2);
    ASSERT_EQ(values[18 * i + 17], 7);
  }
  function->evaluate({}, 2, {});
}

TEST(Process, AnswersMayComeInBlocks) {
  // A program that gathers its answers until the last request, and one that answers in pieces of lines.
  std::vector<double> values(3 * 500);
  python(
      "import sys\nlines = [sys.stdin.readline() for k in range(500)]\nprint('1,2,3\\n' * 500, flush=True, end='')\n"
      "sys.stdin.read()")
      ->evaluate(places(500), 0, values);
  for (int i = 0; i < 1500; ++i) ASSERT_EQ(values[i], i % 3 + 1);
  values.resize(3);
  python(
      "import sys, time\nsys.stdin.readline()\nfor part in '+1.5 ', '2e-3\\t', ' -0.25', '\\r\\n':\n"
      "  sys.stdout.write(part)\n  sys.stdout.flush()\n  time.sleep(0.02)\nsys.stdin.read()")
      ->evaluate(places(1), 0, values);
  EXPECT_EQ(values, (std::vector<double>{1.5, 2e-3, -0.25}));
}

TEST(Process, WhatItSaysDoesNotBlockIt) {
  const auto function = python(kPlane +
                               "sys.stderr.write('x' * 1000)\n  sys.stderr.flush()\n  print(u, v, 0, flush=True)\n"
                               "  if float(u) > 100: sys.exit('enough')");
  std::vector<double> values(3 * 600);
  function->evaluate(places(600), 0, values);
  EXPECT_NO_THROW(function->evaluate(places(600), 0, values));
  std::vector<double> far{1000, 0, 1001, 0};
  values.resize(6);
  try {
    function->evaluate(far, 0, values);
    FAIL();
  } catch (const ExternalError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("ended with exit code 1; asked for u = 1001, v = 0"), std::string::npos) << said;
    EXPECT_NE(said.find("xxxenough"), std::string::npos) << said;
    EXPECT_LE(said.size(), 2500u);
  }
  // It stays broken.
  EXPECT_NE(complaint(*function).find("ended with exit code 1"), std::string::npos);
}

TEST(Process, FaultsAreTold) {
  EXPECT_NE(complaint(*python(kPlane + "print('1 2 3 4', flush=True)")).find("4 numbers in place of 3"),
            std::string::npos);
  EXPECT_NE(complaint(*python(kPlane + "print('1 2 3\\n4 5 6', flush=True)")).find("more than was asked for"),
            std::string::npos);
  EXPECT_NE(complaint(*python("while True: print('1', end='')")).find("a line without an end"), std::string::npos);
  EXPECT_NE(complaint(*python("import os, time\nos.close(1)\ntime.sleep(20)")).find("closed its output"),
            std::string::npos);
  EXPECT_NE(complaint(*python("import time\ntime.sleep(20)", 0.2)).find("no answer for 0.2 s"), std::string::npos);
}

TEST(Process, ThreadsTakeTurns) {
  const auto function = python(kPlane + "print(u, v, 0, flush=True)");
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
    threads.emplace_back([&, k] {
      const std::vector<double> place{static_cast<double>(k), 0.5};
      for (int i = 0; i < 50; ++i) {
        std::vector<double> values(3);
        function->evaluate(place, 0, values);
        EXPECT_EQ(values[0], k);
      }
    });
  for (std::thread& thread : threads) thread.join();
}

TEST(Process, OneThatDoesNotEndIsKilled) {
  const auto begin = std::chrono::steady_clock::now();
  python("import signal, time\nsignal.signal(signal.SIGTERM, signal.SIG_IGN)\ntime.sleep(60)").reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

}  // namespace
}  // namespace lekalo::render::process_test
