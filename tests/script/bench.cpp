#include "bench.hpp"

namespace dotyk::script {

Bench::Bench() {
  auto& library = interpreter.library();
  library.type<Other>("Something else.");
  library.type<Toy>("A toy.")
      .field("name", "what it is called", [](const Toy& toy) { return toy.name; })
      .field(
          "size", "how large it is", [](const Toy& toy) { return toy.size; }, "length")
      .field("facts", "more about it",
             [](const Toy& toy) {
               return Record{"facts", {{"size", toy.size}, {"good", true}}};
             })
      .method({.name = "toy:grow",
               .help = "Makes it larger.",
               .example = "toy:grow(2)",
               .arguments = {key::positive("factor", "how much").required()},
               .returns = "toy",
               .run =
                   [](Call& call) {
                     call.self<Toy>()->size *= call.number("factor");
                     return call.give_self();
                   }})
      .method({.name = "toy:part",
               .help = "Gives its argument back.",
               .example = "toy:part \"head\"",
               .arguments = {key::string("name", "which").required().of<Toy>([](const Toy& toy) {
                               return std::vector<std::string>{toy.name + "'s head", toy.name + "'s tail"};
                             }),
                             key::choice("end", {"near", "far"}, "which end")},
               .run = [](Call& call) { return call.give(call.text("name")); }})
      .text([](const Toy& toy) { return "toy '" + toy.name + "'"; });
  library.function({.name = "dotyk.test.other",
                    .help = "Makes an other.",
                    .example = "dotyk.test.other()",
                    .returns = "other",
                    .run = [](Call& call) { return call.give(std::make_shared<Other>()); }});
  library.function(
      {.name = "dotyk.test.toy",
       .help = "Makes a toy.",
       .example = "dotyk.test.toy{ name = 'a' }",
       .arguments = {key::table(
           {key::string("name", "what it is called").required(),
            key::positive("size", "how large it is").unit("length").fallback(1.0),
            key::choice("colour", {"red", "green", "blue"}, "its colour").fallback("red"),
            key::integer("count", "how many").at_least(0), key::boolean("old", "is it old").fallback(false),
            key::vector("at", "where it is").count(2, 3), key::matrix("stiffness", "how stiff it is"),
            key::list("cells", key::integer("", "").at_least(1), "cells").count(2, 3),
            key::field("weight", "how heavy it is"), key::object<Toy>("parent", "whose part it is"),
            key::table("left", {key::number("deflection", "how far")}, "its left end"),
            key::list("series", key::table("", {key::string("name", "label").required()}, "one"), "series"),
            key::either("error", {key::choice("", {"energy", "pressure"}, ""), key::function("", "")},
                        "a measure")})},
       .returns = "toy",
       .run = [this](Call& call) {
         auto toy = std::make_shared<Toy>(Toy{call.text("name"), call.number("size")});
         text = call.text("colour");
         numbers = {call.boolean("old") ? 1.0 : 0.0};
         if (call.has("weight")) {
           const auto weight = call.field("weight", 2);
           const double point[] = {0.5, 1};
           numbers = weight(point);
         }
         if (call.has("at")) numbers = call.vector("at");
         if (call.has("left")) numbers = {call.table("left").number("deflection")};
         if (call.has("series")) text = call.tables("series").back().text("name");
         toys.push_back(toy);
         return call.give(toy);
       }});
  library.function({.name = "dotyk.test.box",
                    .help = "Holds two toys.",
                    .example = "dotyk.test.box{ a, b }",
                    .arguments = {key::table({key::number("gap", "between them").fallback(0.0)})
                                      .with(key::object<Toy>("toys", "the toys").count(2))},
                    .run = [this](Call& call) {
                      numbers.clear();
                      for (const auto& toy : call.items<Toy>()) numbers.push_back(toy->size);
                      return 0;
                    }});
  library.function({.name = "dotyk.test.each",
                    .help = "Calls a function.",
                    .example = "dotyk.test.each(print)",
                    .arguments = {key::function("f", "called").required()},
                    .run = [](Call& call) {
                      return call.give(call.function("f")(1, Record{"", {{"residual", 0.5}}}));
                    }});
  library.function({.name = "dotyk.test.fail",
                    .help = "Throws.",
                    .example = "dotyk.test.fail('memory')",
                    .arguments = {key::string("how", "what to throw").required()},
                    .run = [](Call& call) -> int {
                      const auto how = call.text("how");
                      if (how == "memory") throw std::bad_alloc();
                      if (how == "runtime") throw std::runtime_error("it broke");
                      throw std::invalid_argument(how);
                    }});
}

}  // namespace dotyk::script
