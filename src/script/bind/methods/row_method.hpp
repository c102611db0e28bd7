#pragma once
// The solver object of a method on rows, which magnetic screws may hold where `kernel` says so.
#include "script/bind/methods/method_keys.hpp"
#include "solver/rows/with_screws.hpp"

namespace dotyk::script {

template <class Method>
int give_row_method(Call& call, Method method, std::string shown) {
  auto screws = screws_of(call, shown);
  if (!screws) return give_method(call, std::move(method), std::move(shown));
  solver::WithScrews held(std::make_shared<const Method>(std::move(method)));
  held.screws = std::move(*screws);
  return give_method(call, std::move(held), std::move(shown));
}

}  // namespace dotyk::script
