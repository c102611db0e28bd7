// The limit for a contact solve: one linear solve on the same mesh, by CHOLMOD with its own settings
// and nothing of dotyk. Built and run by contact_vs_linear.lua; by hand:
//
//   g++ -O3 -I/usr/include/suitesparse linear_limit.cpp -lcholmod \
//       -L/usr/lib/x86_64-linux-gnu/openblas-pthread -lopenblas -o linear_limit
//   ./linear_limit DIMENSION N RUNS
//
// The block (-1,1)x(-1,0) of N x N/2 cells, or the unit cube of N³ cells, P1 as dotyk cuts them, plane
// strain or space, E = 1000, ν = 0.3, held below, loaded on top. Prints "ORDERING SECONDS UNKNOWNS", the
// median over RUNS of assembly + ordering (on the graph of nodes) + factorisation + substitution.

#include <cholmod.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

namespace {

int dim, cells[3] = {1, 1, 1};
double h[3] = {1, 1, 1};

int nodes_along(int i) { return i < dim ? cells[i] + 1 : 1; }
int node_at(const int* at) { return (at[2] * nodes_along(1) + at[1]) * nodes_along(0) + at[0]; }

// The simplices of a cell as paths of axes from its least to its greatest corner.
std::vector<std::vector<int>> paths() {
  if (dim == 2) return {{0, 1}, {1, 0}};
  return {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
}

// Stiffness of the simplex along a path: gradients are differences along its axes.
void element(const std::vector<int>& path, double k[4][4][3][3]) {
  const double E = 1000, nu = 0.3, mu = E / (2 * (1 + nu)), lambda = E * nu / ((1 + nu) * (1 - 2 * nu));
  double g[4][3] = {};
  for (int s = 0; s < dim; ++s) {
    g[s][path[s]] -= 1 / h[path[s]];
    g[s + 1][path[s]] += 1 / h[path[s]];
  }
  const double volume = h[0] * h[1] * h[2] / (dim == 2 ? 2 : 6);
  for (int a = 0; a <= dim; ++a)
    for (int b = 0; b <= dim; ++b)
      for (int i = 0; i < dim; ++i)
        for (int j = 0; j < dim; ++j) {
          double dot = 0;
          for (int l = 0; l < dim; ++l) dot += g[a][l] * g[b][l];
          k[a][b][i][j] = volume * (lambda * g[a][i] * g[b][j] + mu * g[a][j] * g[b][i] + (i == j) * mu * dot);
        }
}

// Lower triangle, unknowns numbered node by node; the bottom nodes have none.
struct Matrix {
  std::vector<int> start, row;
  std::vector<double> value;
  int nodes, first;  // the first node that is not held
};

Matrix assemble() {
  Matrix m;
  m.nodes = nodes_along(0) * nodes_along(1) * nodes_along(2);
  int up[3] = {0, 0, 0};
  up[dim - 1] = 1;
  m.first = node_at(up);
  // Neighbours with greater numbers: those that share a path.
  std::vector<int> offsets;
  for (const auto& path : paths()) {
    int at[3] = {0, 0, 0};
    std::vector<int> seen{0};
    for (int axis : path) {
      ++at[axis];
      for (int n : seen) offsets.push_back(node_at(at) - n);
      seen.push_back(node_at(at));
    }
  }
  offsets.push_back(0);
  std::sort(offsets.begin(), offsets.end());
  offsets.erase(std::unique(offsets.begin(), offsets.end()), offsets.end());
  const int slots = static_cast<int>(offsets.size());
  std::vector<double> block(static_cast<std::size_t>(m.nodes) * slots * dim * dim, 0.0);
  double k[6][4][4][3][3];
  const auto all = paths();
  for (std::size_t p = 0; p < all.size(); ++p) element(all[p], k[p]);
  int at[3];
  for (at[2] = 0; at[2] < (dim == 3 ? cells[2] : 1); ++at[2])
    for (at[1] = 0; at[1] < cells[1]; ++at[1])
      for (at[0] = 0; at[0] < cells[0]; ++at[0])
        for (std::size_t p = 0; p < all.size(); ++p) {
          int corner[3] = {at[0], at[1], at[2]}, n[4] = {node_at(corner)};
          for (int s = 0; s < dim; ++s) ++corner[all[p][s]], n[s + 1] = node_at(corner);
          for (int a = 0; a <= dim; ++a)
            for (int b = 0; b <= a; ++b) {
              const int slot = static_cast<int>(std::lower_bound(offsets.begin(), offsets.end(), n[a] - n[b]) - offsets.begin());
              double* to = &block[(static_cast<std::size_t>(n[b]) * slots + slot) * dim * dim];
              for (int i = 0; i < dim; ++i)
                for (int j = 0; j < dim; ++j) to[i * dim + j] += k[p][a][b][i][j];
            }
        }
  // Into columns; slots that no simplex fills (across the end of a grid line) are left out.
  m.start.push_back(0);
  for (int b = m.first; b < m.nodes; ++b)
    for (int j = 0; j < dim; ++j) {
      for (int s = 0; s < slots; ++s) {
        const double* from = &block[(static_cast<std::size_t>(b) * slots + s) * dim * dim];
        const bool empty = std::all_of(from, from + dim * dim, [](double v) { return v == 0; });
        if (empty || b + offsets[s] >= m.nodes) continue;
        for (int i = s == 0 ? j : 0; i < dim; ++i) {
          m.row.push_back((b + offsets[s] - m.first) * dim + i);
          m.value.push_back(from[i * dim + j]);
        }
      }
      m.start.push_back(static_cast<int>(m.row.size()));
    }
  return m;
}

cholmod_sparse view(Matrix& m) {
  cholmod_sparse a{};
  a.nrow = a.ncol = m.start.size() - 1;
  a.nzmax = m.row.size();
  a.p = m.start.data();
  a.i = m.row.data();
  a.x = m.value.data();
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.sorted = a.packed = 1;
  return a;
}

double solve(bool metis, std::size_t* unknowns) {
  const auto begin = std::chrono::steady_clock::now();
  Matrix m = assemble();
  cholmod_sparse a = view(m);
  *unknowns = a.nrow;
  cholmod_common c;
  cholmod_start(&c);
  c.supernodal = CHOLMOD_SUPERNODAL;
  c.final_ll = 1;
  // The graph of nodes: every dim-th column, rows divided by dim.
  Matrix g;
  g.start.push_back(0);
  for (std::size_t b = 0; b < a.nrow; b += dim) {
    for (int k = m.start[b]; k < m.start[b + 1]; ++k)
      if (g.row.size() == static_cast<std::size_t>(g.start.back()) || g.row.back() != m.row[k] / dim)
        g.row.push_back(m.row[k] / dim);
    g.start.push_back(static_cast<int>(g.row.size()));
  }
  cholmod_sparse graph = view(g);
  graph.xtype = CHOLMOD_PATTERN;
  std::vector<int> order(graph.nrow), all;
  if (metis)
    cholmod_metis(&graph, nullptr, 0, 1, order.data(), &c);
  else
    cholmod_amd(&graph, nullptr, 0, order.data(), &c);
  for (int n : order)
    for (int i = 0; i < dim; ++i) all.push_back(n * dim + i);
  c.nmethods = 1;
  c.method[0].ordering = CHOLMOD_GIVEN;
  cholmod_factor* factor = cholmod_analyze_p(&a, all.data(), nullptr, 0, &c);
  cholmod_factorize(&a, factor, &c);
  cholmod_dense* b = cholmod_ones(a.nrow, 1, CHOLMOD_REAL, &c);
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor, b, &c);
  cholmod_free_dense(&x, &c);
  cholmod_free_dense(&b, &c);
  cholmod_free_factor(&factor, &c);
  cholmod_finish(&c);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main(int count, char** argument) {
  if (count != 4) return 2;
  dim = std::atoi(argument[1]);
  const int n = std::atoi(argument[2]), runs = std::atoi(argument[3]);
  cells[0] = n, cells[1] = dim == 2 ? n / 2 : n, cells[2] = dim == 2 ? 1 : n;
  for (int i = 0; i < dim; ++i) h[i] = (dim == 2 ? 2.0 : 1.0) / n;
  for (const bool metis : {false, true}) {
    std::vector<double> seconds;
    std::size_t unknowns = 0;
    for (int r = 0; r < runs; ++r) seconds.push_back(solve(metis, &unknowns));
    std::sort(seconds.begin(), seconds.end());
    std::printf("%s %.4f %zu\n", metis ? "METIS" : "AMD", seconds[runs / 2], unknowns);
  }
}
