// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/parallel/partition.h"

#include "core/base/error.h"

#include <mpi.h>
#include <zoltan.h>

#include <algorithm>
#include <numeric>

namespace ogive
{
namespace
{
template <int dim>
struct Points
{
  const std::array<std::span<const double>, dim> &x;
  std::span<const double>                         weight;
  ZOLTAN_ID_TYPE                                  first; ///< global number of the first
};

template <int dim>
const Points<dim> &points(void *data)
{
  return *static_cast<const Points<dim> *>(data);
}

template <int dim>
int number_of_points(void *data, int *error)
{
  *error = ZOLTAN_OK;
  return static_cast<int>(points<dim>(data).weight.size());
}

template <int dim>
void list_points(void *data, int, int, ZOLTAN_ID_PTR global, ZOLTAN_ID_PTR local, int, float *weight, int *error)
{
  const auto &p = points<dim>(data);
  for (std::size_t k = 0; k < p.weight.size(); ++k)
  {
    global[k] = p.first + static_cast<ZOLTAN_ID_TYPE>(k);
    local[k]  = static_cast<ZOLTAN_ID_TYPE>(k);
    weight[k] = static_cast<float>(p.weight[k]);
  }
  *error = ZOLTAN_OK;
}

template <int dim>
int number_of_coordinates(void *, int *error)
{
  *error = ZOLTAN_OK;
  return dim;
}

template <int dim>
void list_coordinates(void *data, int, int, int n, ZOLTAN_ID_PTR, ZOLTAN_ID_PTR local, int, double *x, int *error)
{
  const auto &p = points<dim>(data);
  for (int k = 0; k < n; ++k)
    for (int a = 0; a < dim; ++a)
      x[k * dim + a] = p.x[a][local[k]];
  *error = ZOLTAN_OK;
}

void check(int status, const char *what)
{
  if (status != ZOLTAN_OK && status != ZOLTAN_WARN)
    throw RunError(std::string("sharing space among ranks failed: ") + what);
}

void start_zoltan()
{
  static const bool started = [] {
    float version = 0;
    check(Zoltan_Initialize(0, nullptr, &version), "start");
    return true;
  }();
  static_cast<void>(started);
}
} // namespace

template <int dim>
struct Partition<dim>::Implementation
{
  Ranks          ranks;
  Zoltan_Struct *zoltan = nullptr; ///< none where this process is alone

  explicit Implementation(const Ranks &r)
    : ranks(r)
  {
    if (ranks.alone())
      return;
    start_zoltan();
    zoltan = Zoltan_Create(*static_cast<const MPI_Comm *>(ranks.communicator()));
    // Cuts lie halfway between points, so that rounding decides on no point's side.
    const char *const settings[][2] = {{"DEBUG_LEVEL", "0"},      {"LB_METHOD", "RCB"},
                                       {"NUM_GID_ENTRIES", "1"},  {"NUM_LID_ENTRIES", "1"},
                                       {"OBJ_WEIGHT_DIM", "1"},   {"RETURN_LISTS", "NONE"},
                                       {"KEEP_CUTS", "1"},        {"RCB_OUTPUT_LEVEL", "0"},
                                       {"IMBALANCE_TOL", "1.001"}, {"RCB_RECTILINEAR_BLOCKS", "1"},
                                       {"AVERAGE_CUTS", "1"},     {"RCB_REUSE", "0"}};
    for (const auto &s : settings)
      check(Zoltan_Set_Param(zoltan, s[0], s[1]), s[0]);
  }
  Implementation(const Implementation &) = delete;
  Implementation &operator=(const Implementation &) = delete;
  ~Implementation()
  {
    int ended = 0;
    MPI_Finalized(&ended);
    if (zoltan && !ended)
      Zoltan_Destroy(&zoltan);
  }
};

template <int dim>
Partition<dim>::Partition(const Ranks &ranks)
  : self_(std::make_unique<Implementation>(ranks))
{}
template <int dim>
Partition<dim>::~Partition() = default;
template <int dim>
Partition<dim>::Partition(Partition &&) noexcept = default;
template <int dim>
Partition<dim> &Partition<dim>::operator=(Partition &&) noexcept = default;

template <int dim>
std::vector<int> Partition<dim>::cut(const std::array<std::span<const double>, dim> &x,
                                     std::span<const double>                          weight)
{
  auto &s = *self_;
  std::vector<int> rank(weight.size(), s.ranks.rank());
  if (s.ranks.alone())
    return rank;
  Points<dim> p{x, weight,
                static_cast<ZOLTAN_ID_TYPE>(s.ranks.before(static_cast<std::int64_t>(weight.size())))};
  Zoltan_Set_Num_Obj_Fn(s.zoltan, number_of_points<dim>, &p);
  Zoltan_Set_Obj_List_Fn(s.zoltan, list_points<dim>, &p);
  Zoltan_Set_Num_Geom_Fn(s.zoltan, number_of_coordinates<dim>, &p);
  Zoltan_Set_Geom_Multi_Fn(s.zoltan, list_coordinates<dim>, &p);
  int           changes = 0, n_global = 1, n_local = 1, n_in = 0, n_out = 0;
  ZOLTAN_ID_PTR in_global = nullptr, in_local = nullptr, out_global = nullptr, out_local = nullptr;
  int          *in_rank = nullptr, *in_part = nullptr, *out_rank = nullptr, *out_part = nullptr;
  check(Zoltan_LB_Partition(s.zoltan, &changes, &n_global, &n_local, &n_in, &in_global, &in_local, &in_rank, &in_part,
                            &n_out, &out_global, &out_local, &out_rank, &out_part),
        "recursive coordinate bisection");
  // No lists were asked for: a point goes where everyone will look for it.
  for (std::size_t k = 0; k < rank.size(); ++k)
  {
    std::array<double, dim> where;
    for (int a = 0; a < dim; ++a)
      where[a] = x[a][k];
    rank[k] = at(where);
  }
  return rank;
}

template <int dim>
int Partition<dim>::at(const std::array<double, dim> &x) const
{
  if (self_->ranks.alone())
    return 0;
  std::array<double, 3> where{};
  std::copy(x.begin(), x.end(), where.begin());
  int rank = 0, part = 0;
  check(Zoltan_LB_Point_PP_Assign(self_->zoltan, where.data(), &rank, &part), "whose box a point lies in");
  return rank;
}

template <int dim>
void Partition<dim>::meets(const std::array<double, dim> &lower, const std::array<double, dim> &upper,
                           std::vector<int> &ranks) const
{
  if (self_->ranks.alone())
  {
    ranks.assign(1, 0);
    return;
  }
  std::array<double, 3> low{}, up{};
  std::copy(lower.begin(), lower.end(), low.begin());
  std::copy(upper.begin(), upper.end(), up.begin());
  ranks.resize(self_->ranks.size());
  int n = 0;
  check(Zoltan_LB_Box_Assign(self_->zoltan, low[0], low[1], low[2], up[0], up[1], up[2], ranks.data(), &n),
        "whose boxes a box meets");
  ranks.resize(n);
  std::sort(ranks.begin(), ranks.end());
}

template <int dim>
void Partition<dim>::box(int rank, std::array<double, dim> &lower, std::array<double, dim> &upper) const
{
  require(!self_->ranks.alone(), "boxes of ranks where there are several");
  int                   n = 0;
  std::array<double, 3> low{}, up{};
  check(Zoltan_RCB_Box(self_->zoltan, rank, &n, &low[0], &low[1], &low[2], &up[0], &up[1], &up[2]), "the box of a rank");
  std::copy_n(low.begin(), dim, lower.begin());
  std::copy_n(up.begin(), dim, upper.begin());
}

template class Partition<1>;
template class Partition<2>;
template class Partition<3>;
} // namespace ogive
