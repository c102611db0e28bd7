// The doors of the library. PETSc knows no threads, so one call at a time goes through.
#include <algorithm>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "multigrid/cycle/cycle.hpp"
#include "multigrid/rank_slices.hpp"
#include "multigrid/shares/messages.hpp"

namespace dotyk::multigrid {

namespace {

Numbering numbered(const Matrix& matrix, int ranks) {
  const std::vector<algebra::CoarseFunctions> no_functions;
  const algebra::SparseRows no_rows;
  const EachPair each_pair = [&, &K = matrix.displaced ? *matrix.displaced : matrix.lower](const auto& visit) {
    for (int j = 0; j < K.cols(); ++j)  // the first of each node
      for (algebra::SparseMatrix::InnerIterator it(K, j); it && (j == 0 || matrix.node[j] != matrix.node[j - 1]); ++it) visit(static_cast<int>(it.row()), j);
  };
  return {{matrix.node, matrix.coarse ? *matrix.coarse : no_functions, matrix.rows ? *matrix.rows : no_rows, each_pair}, ranks};
}

/// The solver as rank 0 has it. The other ranks have a Cycle each, and do what this one tells them.
class PetscSolver final : public algebra::SpdSolver {
 public:
  PetscSolver(const Matrix& matrix, Monitor& monitor)
      : monitor_(monitor), most_(matrix.most_iterations), geometric_(matrix.coarse), slices_(matrix.slices ? &dynamic_cast<const RankSlices&>(*matrix.slices) : nullptr),
        workers_(slices_ ? slices_->workers().next() : workers_for(static_cast<double>(matrix.lower.rows()))),
        numbering_(slices_ ? slices_->numbering() : std::make_shared<const Numbering>(numbered(matrix, workers_.ranks().count()))), sharing_(sharing_unknowns(matrix)) {
    const Ranks& ranks = workers_.ranks();
    auto pieces = std::make_unique<Pieces>(matrix, *numbering_, ranks.count());
    std::shared_ptr<const RankSlices> coarser;
    ranks.together([&] {
      const bool asked = matrix.coarser && geometric_;
      const Workers of_coarser = workers_.next();
      Piece own = share_out(*pieces, asked ? of_coarser.number() : 0);
      pieces.reset();  // making the levels takes the most memory
      cycle_ = std::make_unique<Cycle>(ranks, std::move(own));
      if (asked)
        coarser = std::make_shared<const RankSlices>(of_coarser, Numbering(*numbering_, matrix.coarse->front()), cycle_->take_coarser(),
                                                     without_first(cycle_->functions()), cycle_->coarser_load());
    });
    workers_.made();
    alone_.unlock();
    if (!coarser) return;
    const auto unknowns = static_cast<double>(coarser->diagonal().size());
    *matrix.coarser = std::shared_ptr<const algebra::SlicedMatrix>(coarser);
    const bool stays = ranks.alone() || numbering_->hides() || cycle_->coarser_load() || several_ranks_have_work(unknowns);
    if (stays) coarser_numbering_ = coarser->numbering();
    else try {
        *matrix.coarser = matrix.coarser->lower();
      } catch (...) {
        drop();
        throw;
      }
  }
  ~PetscSolver() override { drop(); }

  bool set(const algebra::Triplets& changed, const std::vector<char>& held) override {
    monitor_.check();
    if (held.size() != numbering_->slot().size()) throw std::runtime_error("multigrid: the matrix has another size than the one that the solver was made for");
    const Ranks& ranks = workers_.ranks();
    std::vector<Change> of = changes(changed, held, sharing_, *numbering_, ranks.count());
    return workers_.run(Task::set, [&](int r) { send(ranks, r, of[r]); }, [&] { return cycle_->set(of[0]); });
  }

  algebra::Vector solve(const algebra::Vector& b, double tolerance, algebra::Vector* left) override {
    const auto unknowns = static_cast<Eigen::Index>(numbering_->slot().size());
    if (b.size() != unknowns) throw std::runtime_error(text("a right-hand side of ", b.size(), " numbers for ", unknowns, " unknowns"));
    const auto room = std::make_shared<RankVectors>(workers_, numbering_, std::vector<int>());
    algebra::Field given(room), x(room), rest(room);
    given.put(b);
    const Solved solved = solve_in(*room, given, tolerance, x, rest);
    if (left) *left = rest.get();
    return solved.found ? x.get() : algebra::Vector::Constant(unknowns, std::numeric_limits<double>::quiet_NaN());
  }

  Solved solve_fields(algebra::Field& b, double tolerance, algebra::Field& x, algebra::Field& left) override {
    RankVectors* room = place_of(b, numbering_);
    return room ? solve_in(*room, b, tolerance, x, left) : SpdSolver::solve_fields(b, tolerance, x, left);
  }

  bool interpolate(const algebra::Field& coarse, algebra::Field& fine) const override {
    RankVectors *from = coarser_numbering_ ? place_of(coarse, coarser_numbering_) : nullptr, *to = place_of(fine, numbering_);
    if (!from || !to) return false;
    const std::vector<int> which{from->number(), coarse.number(), to->number(), fine.number()};
    workers_.run(Task::interpolate, [&](int r) { workers_.ranks().send(r, which); },
                 [&] { cycle_->interpolate(from->own()[coarse.number()], to->own()[fine.number()]); });
    return true;
  }

  double bytes() const override {
    const std::lock_guard lock(only_one());
    return cycle_->bytes();
  }
  int iterations() const override { return iterations_; }
  int levels() const override { return cycle_->levels(); }
  std::string method() const override {
    const int ranks = workers_.ranks().count();
    return text("conjugate gradients, ", geometric_ ? "geometric" : "algebraic", " multigrid (PETSc ", PETSC_VERSION_MAJOR, ".", PETSC_VERSION_MINOR, ", ", levels(),
                levels() == 1 ? " level" : " levels", ranks > 1 ? text(", ", ranks, " ranks)") : ")");
  }

 private:
  void drop() {
    alone_.lock();
    workers_.tell(Task::drop);
    cycle_.reset();
  }
  /// Where the field lies, if that is with this numbering; else null.
  static RankVectors* place_of(const algebra::Field& field, const std::shared_ptr<const Numbering>& numbering) {
    auto* of_ranks = dynamic_cast<RankVectors*>(field.where().get());
    return of_ranks && &of_ranks->numbering() == numbering.get() ? of_ranks : nullptr;
  }
  /// Sends each other rank its piece; returns that of rank 0. `coarser`: as in Piece. Pieces are made in parallel, as many at a time as there are
  /// cores. The first are made before the other ranks are told to begin, because a rank keeps a core busy while it waits for its piece.
  Piece share_out(Pieces& pieces, int coarser) const {
    const Ranks& ranks = workers_.ranks();
    Piece own;
    for (int from = 0; from < ranks.count();) {
      std::vector<Piece> some(static_cast<std::size_t>(std::min(cores(), ranks.count() - from)));
      parallel_for(static_cast<int>(some.size()), [&](int k) { some[k] = pieces.of(from + k); });
      if (from == 0) workers_.tell(Task::make);
      for (Piece& piece : some) {
        piece.slices = slices_ ? slices_->workers().number() : 0, piece.coarser = coarser;
        if (from == 0) own = std::move(piece);
        else send(ranks, from, piece);
        piece = {}, ++from;
      }
    }
    if (slices_) take_matrix(own, slices_->own());
    return own;
  }
  Solved solve_in(RankVectors& room, const algebra::Field& b, double tolerance, algebra::Field& x, algebra::Field& left) {
    const std::vector<int> which{room.number(), b.number(), x.number(), left.number()};
    const Cycle::Solution own = workers_.run(
        Task::solve, [&](int r) { workers_.ranks().send(r, which), workers_.ranks().send(r, std::vector<double>{tolerance, most_}); },
        [&] { return cycle_->solve(room.own()[b.number()], tolerance, most_, &monitor_, room.own()[x.number()], room.own()[left.number()]); });
    iterations_ += own.iterations;
    if (own.thrown) std::rethrow_exception(own.thrown);
    return {own.found, true};
  }

  std::unique_lock<std::mutex> alone_{only_one()};  // while the members after it are made, and while they are destroyed
  Monitor& monitor_;
  const double most_;  // iterations
  const bool geometric_;
  const RankSlices* const slices_;  // of the matrix that it is made from, until it is made; null: none
  Workers workers_;
  const std::shared_ptr<const Numbering> numbering_;
  std::shared_ptr<const Numbering> coarser_numbering_;  ///< of the slices of the next coarser mesh's matrix; null: there are none
  const std::set<int> sharing_;
  std::unique_ptr<Cycle> cycle_;
  int iterations_ = 0;
};

}  // namespace

}  // namespace dotyk::multigrid

#define DOTYK_DOOR extern "C" __attribute__((visibility("default")))

DOTYK_DOOR dotyk::algebra::SpdSolver* dotyk_multigrid_solver(const dotyk::multigrid::Matrix& matrix, dotyk::Monitor& monitor) {
  dotyk::multigrid::start_petsc();
  monitor.check();
  auto solver = std::make_unique<dotyk::multigrid::PetscSolver>(matrix, monitor);
  monitor.check();
  return solver.release();
}

DOTYK_DOOR void dotyk_multigrid_meet() { dotyk::multigrid::meet_workers(); }
DOTYK_DOOR void dotyk_multigrid_end_ranks() { dotyk::multigrid::end_workers(); }
DOTYK_DOOR void dotyk_multigrid_spawn(int ranks, const char* program) { dotyk::multigrid::spawn_workers(ranks, program); }
DOTYK_DOOR int dotyk_multigrid_ranks() { return dotyk::multigrid::ranks_now(); }
DOTYK_DOOR void dotyk_multigrid_work(bool spawned, const dotyk::multigrid::ShareMakers& makers) { dotyk::multigrid::work(spawned, makers); }
DOTYK_DOOR void dotyk_multigrid_start() { dotyk::multigrid::start_petsc(); }
DOTYK_DOOR bool dotyk_multigrid_share(double unknowns) { return dotyk::multigrid::several_ranks_have_work(unknowns); }
DOTYK_DOOR dotyk::algebra::SlicedMatrix* dotyk_multigrid_slices(const dotyk::multigrid::Shared& matrix) {
  using namespace dotyk::multigrid;
  const std::lock_guard lock(only_one());
  return new RankSlices(workers_for(static_cast<double>(matrix.coupling.node.size())), matrix);
}
DOTYK_DOOR void dotyk_multigrid_visit(const dotyk::multigrid::Visit& visit, std::vector<dotyk::Lists>& told) {
  told = dynamic_cast<dotyk::multigrid::RankVectors&>(*visit.u.where()).visit(visit);
}
DOTYK_DOOR dotyk::algebra::SlicedMatrix* dotyk_multigrid_refined_slices(const dotyk::multigrid::Refined& matrix) {
  using namespace dotyk::multigrid;
  const std::lock_guard lock(only_one());
  return new RankSlices(workers_for(static_cast<double>(matrix.base.coupling.node.size()) * (1 << (matrix.coarse.front().dimension * matrix.times))), matrix);
}
