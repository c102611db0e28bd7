#include <doctest/doctest.h>

#include "../support/plate_laws.hpp"

using namespace dotyk;
using plate::Plate;
using plate::Solution;
namespace laws = dotyk::problem::laws;
using test::kElements;
using test::kFree;
using test::kHeld;
using test::LawChoice;

namespace {

/// A square clamped at the left; the law at the other sides; loaded so that corners would lift.
Plate cantilever(plate::Element element, const plate::LawField& deflection, const plate::LawField& rotation, int cells = 8) {
  test::Mesh m = test::rectangle(test::Family::p1, cells, cells);
  test::distort(m, 0.05);
  Plate p = test::plate_on(std::move(m), element);
  p.f_of = [](double x, double y) { return -1 + 4 * x * y; };
  test::support(p, "left", kHeld, kHeld);
  for (const char* part : {"right", "bottom", "top"}) test::support(p, part, deflection, rotation);
  return p;
}
std::shared_ptr<const Solution> with(plate::Element element, LawChoice deflection, LawChoice rotation) {
  const auto s = test::solved(cantilever(element, test::always(deflection), test::always(rotation)));
  REQUIRE(s->result().converged);
  CHECK(test::off_laws(*s) < 1e-8);
  return s;
}

/// Of the vertices' deflections: the frames of their gradients are not the same where other ones are held.
double apart(const Solution& a, const Solution& b) {
  double off = 0, size = 0;
  for (int n = 0; n < a.plate().mesh->node_count(); ++n) {
    off += std::pow(a.vertex_deflection(n) - b.vertex_deflection(n), 2);
    size += std::pow(b.vertex_deflection(n), 2);
  }
  return std::sqrt(off / size);
}

/// The law at the deflection, or at the rotation with the deflection free.
std::shared_ptr<const Solution> of(plate::Element element, bool deflection, LawChoice law) {
  return deflection ? with(element, law, kFree) : with(element, kFree, law);
}

template <class Check>
void each(const Check& check) {
  for (const plate::Element element : kElements)
    for (const bool deflection : {true, false}) {
      CAPTURE(std::string(plate::element_name(element)));
      CAPTURE(deflection);
      check([&, element, deflection](LawChoice law) { return of(element, deflection, law); });
    }
}

}  // namespace

TEST_CASE("elastic supports: of stiffness k → ∞ what is held with 1/k, of k → 0 none with k") {
  each([](const auto& with_law) {
    const auto held = with_law(kHeld), none = with_law(kFree);
    // What is held and what an infinitely stiff spring holds are the same but where HCT's corners are held in their slopes, too.
    double last = 0, now = 0;
    for (const double k : {1e-4, 1e-5}) last = now, now = apart(*with_law({&laws::elastic, k}), *none);
    CHECK(last / now == doctest::Approx(10).epsilon(0.02));
    double stiff = 0, stiffer = 0;
    for (const double k : {1e6, 1e7}) stiff = stiffer, stiffer = apart(*with_law({&laws::elastic, k}), *with_law({&laws::friction, 1e9}));
    CHECK(stiff / stiffer == doctest::Approx(10).epsilon(0.05));
    CHECK(apart(*with_law({&laws::elastic, 1e8}), *held) < 0.02);
  });
}

TEST_CASE("one-sided elastic supports tend to Signorini's with 1/k") {
  each([](const auto& with_law) {
    const auto rigid = with_law({&laws::signorini});
    CHECK(rigid->result().state.lambda.minCoeff() >= 0);
    double last = 0, now = 0;
    for (const double k : {1e7, 1e8}) last = now, now = apart(*with_law({&laws::one_sided_elastic, k}), *rigid);
    CHECK(last / now == doctest::Approx(10).epsilon(0.05));
  });
}

TEST_CASE("friction of a bound beyond all reactions holds as what is prescribed does") {
  each([](const auto& with_law) {
    const auto a = with_law({&laws::friction, 1e4}), b = with_law({&laws::friction, 1e8});
    CHECK(apart(*a, *b) < 1e-9);
    CHECK(apart(*a, *with_law(kHeld)) < 0.02);
  });
  // Morley's freedoms are what laws act on: exactly.
  for (const bool deflection : {true, false})
    CHECK(apart(*of(plate::Element::morley, deflection, {&laws::friction, 1e4}), *of(plate::Element::morley, deflection, kHeld)) < 1e-9);
}

TEST_CASE("laws that are the same in other words") {
  each([](const auto& with_law) {
    const auto elastic = with_law({&laws::elastic, 7});
    CHECK(apart(*with_law({&laws::unequal_elastic, 7, 7}), *elastic) < 1e-9);
    CHECK(apart(*with_law({&laws::capped_elastic, 7, 1e6}), *elastic) < 1e-9);
    CHECK(apart(*with_law({&laws::unequal_elastic, 7, 0}), *with_law({&laws::one_sided_elastic, 7})) < 1e-9);
    CHECK(apart(*with_law({&laws::one_sided_friction, 1e6}), *with_law({&laws::signorini})) < 1e-9);
    CHECK(apart(*with_law({&laws::capped_elastic, 1e9, 0.02}), *with_law({&laws::friction, 0.02})) < 1e-4);
    CHECK(apart(*with_law({&laws::friction, 0}), *with_law(kFree)) < 1e-9);
    CHECK(apart(*with_law({&laws::elastic, 0}), *with_law(kFree)) < 1e-9);
    CHECK(apart(*with_law({&laws::prescribed, 0}), *with_law(kHeld)) < 1e-15);
  });
}

TEST_CASE("caps and bounds in between: some points yield, some do not, and the law holds at each") {
  for (const plate::Element element : kElements)
    for (const LawChoice law : {LawChoice{&laws::friction, 0.2}, LawChoice{&laws::one_sided_friction, 0.4}, LawChoice{&laws::capped_elastic, 200, 0.2}}) {
      Plate p = cantilever(element, test::always(law), {});
      if (law->one_sided()) p.f_of = [](double, double) { return -1; };
      const auto s = test::solved(p);
      CHECK(test::off_laws(*s) < 1e-8);
      int stuck = 0, yields = 0;
      for (const auto& edge : {1, 2, 3})
        for (const auto& piece : plate::reaction(*s, edge).pieces)
          for (const auto& point : piece) {
            stuck += point.status == problem::Status::stick;
            yields += point.status == problem::Status::slip;
          }
      CHECK(stuck > 2);
      CHECK(yields > 2);
    }
}

TEST_CASE("laws by functions: those of parts that the function tells apart, and of numbers that change along the edge") {
  for (const plate::Element element : kElements) {
    // One function for three sides that is one law on the right and another at the bottom and the top, but for their corners.
    const auto by_side = [](double x, double) { return x > 1 - 1e-9 ? LawChoice{&laws::elastic, 5} : LawChoice{&laws::elastic, 2}; };
    Plate parts = cantilever(element, test::always({&laws::elastic, 2}), {});
    parts.edges[1].deflection = test::always({&laws::elastic, 5});
    for (const int cells : {8, 16}) {
      const auto a = test::solved(cantilever(element, by_side, {}, cells));
      Plate of_parts = cantilever(element, test::always({&laws::elastic, 2}), {}, cells);
      of_parts.edges[1].deflection = test::always({&laws::elastic, 5});
      // Corners stand for half of an edge of the mesh with 5 in place of 2.
      CHECK(apart(*a, *test::solved(of_parts)) < 1.0 / cells);
    }
    // Any law that changes from point to point is obeyed at each, and called once a point.
    int calls = 0;
    const plate::LawField mixed = [&calls](double x, double y) {
      ++calls;
      const int which = static_cast<int>(std::floor(8.5 * x + 5.3 * y)) % 6;
      switch (which) {
        case 0: return LawChoice{&laws::elastic, 3 + x};
        case 1: return LawChoice{&laws::signorini};
        case 2: return LawChoice{&laws::friction, 0.1 + y / 9};
        case 3: return LawChoice{&laws::unequal_elastic, 30 * (1 + x), 2};
        case 4: return LawChoice{&laws::load, 0.03};
        default: return LawChoice{&laws::capped_elastic, 20, 0.05};
      }
    };
    const Plate p = cantilever(element, mixed, mixed);
    const auto s = test::solved(p);
    REQUIRE(s->result().converged);
    if (element == plate::Element::morley) CHECK(test::off_laws(*s) < 1e-8);
    else CHECK(s->residual().law < 1e-8);
    const int after = calls;
    s->deflection(0.5, 0.5);
    plate::reaction(*s, 2);
    CHECK(calls == after);
  }
}
