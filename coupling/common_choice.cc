// SPDX-License-Identifier: LGPL-2.1-or-later
#include "coupling/common_particles.h"
#include "coupling/marked_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

/// Which particles the coupling layer can need.
namespace ogive::coupling
{
namespace
{
// Share of the longest reach by which points may come nearer before it is settled
// anew who matters.
constexpr double slack_share = .25;
// Cells about facets are this much finer than what is near them.
constexpr double fine = .25;

template <int dim>
Point<dim> place_of(const Surface<dim> &surface, std::size_t i)
{
  Point<dim> p;
  for (int a = 0; a < dim; ++a)
    p[a] = surface.x[a][i];
  return p;
}

template <int dim>
Box<dim> common_part(const Box<dim> &a, const Box<dim> &b)
{
  Box<dim> both;
  both.lower = a.lower.cwiseMax(b.lower);
  both.upper = a.upper.cwiseMin(b.upper);
  return both;
}
} // namespace

template <int dim>
void CommonParticles<dim>::attend(std::vector<Attention> wanted)
{
  wanted_.clear();
  for (const Attention &w : wanted)
  {
    const auto same = std::find_if(wanted_.begin(), wanted_.end(), [&](const Attention &k) {
      return k.body == w.body && k.other == w.other && k.party == w.party;
    });
    if (same == wanted_.end())
      wanted_.push_back(w);
    else
      same->reach = std::max(same->reach, w.reach);
  }
  everyone_       = false;
  stale_          = true;
  watches_damage_ = std::any_of(wanted_.begin(), wanted_.end(), [](const auto &w) { return w.body == w.other; });
  set_slack();
}

template <int dim>
void CommonParticles<dim>::attend_seam(const std::string &name, NearSeam seam)
{
  seams_[name] = std::move(seam);
  stale_       = true;
  set_slack();
}

template <int dim>
void CommonParticles<dim>::set_slack()
{
  slack_ = 0;
  for (const auto &w : wanted_)
    if (std::isfinite(w.reach))
      slack_ = std::max(slack_, slack_share * w.reach);
  for (const auto &[name, seam] : seams_)
    slack_ = std::max(slack_, slack_share * seam.reach);
}

template <int dim>
bool CommonParticles<dim>::idle() const
{
  return !everyone_ && wanted_.empty() && seams_.empty() && slaves_.empty();
}

template <int dim>
bool CommonParticles<dim>::moved(const Surface<dim> &own, const Surface<dim> &mesh) const
{
  if (everyone_ || slack_ == 0)
    return false; // whoever comes changes the lists
  if (mesh.topology != mesh_lists_)
    return true;
  // Both may have moved towards each other.
  const double near = .25 * slack_ * slack_;
  std::size_t  k    = 0;
  for (const auto &facet : mesh.facets)
    for (const std::uint32_t i : facet.node)
      if (!((place_of<dim>(mesh, i) - mesh_settled_[k++]).squaredNorm() <= near))
        return true;
  for (std::size_t i = 0; i < own.n; ++i)
  {
    double square = 0;
    for (int a = 0; a < dim; ++a)
      square += (own.x[a][i] - x_settled_[a][i]) * (own.x[a][i] - x_settled_[a][i]);
    if (!(square <= near))
      return true;
  }
  return false;
}

template <int dim>
void CommonParticles<dim>::note_places(const Surface<dim> &own, const Surface<dim> &mesh)
{
  for (int a = 0; a < dim; ++a)
    x_settled_[a].assign(own.x[a].begin(), own.x[a].end());
  mesh_settled_.clear();
  for (const auto &facet : mesh.facets)
    for (const std::uint32_t i : facet.node)
      mesh_settled_.push_back(place_of<dim>(mesh, i));
  mesh_lists_ = mesh.topology;
}

template <int dim>
auto CommonParticles<dim>::body_boxes(const Surface<dim> &own) const -> Boxes
{
  int last = -1;
  for (const auto &w : wanted_)
    last = std::max({last, w.body, w.other});
  for (const auto &[name, seam] : seams_)
    last = std::max(last, seam.body);
  Boxes boxes(static_cast<std::size_t>(last + 1));
  for (std::size_t i = 0; i < own.n; ++i)
    if (own.body[i] >= 0 && own.body[i] <= last)
      boxes[static_cast<std::size_t>(own.body[i])].include(place_of<dim>(own, i));
  std::vector<double> ends;
  for (const auto &box : boxes)
    for (int a = 0; a < dim; ++a)
      ends.insert(ends.end(), {-box.lower[a], box.upper[a]});
  ranks_.max(std::span<double>(ends));
  for (std::size_t b = 0; b < boxes.size(); ++b)
    for (int a = 0; a < dim; ++a)
    {
      boxes[b].lower[a] = -ends[2 * (b * dim + static_cast<std::size_t>(a))];
      boxes[b].upper[a] = ends[2 * (b * dim + static_cast<std::size_t>(a)) + 1];
    }
  return boxes;
}

template <int dim>
std::vector<char> CommonParticles<dim>::chosen(const Surface<dim> &own, const Surface<dim> &mesh) const
{
  const Boxes       boxes = body_boxes(own);
  std::vector<char> take(own.n, 0);
  for (const auto &w : wanted_)
    if (!std::isfinite(w.reach) || w.body == w.other)
    {
      for (std::size_t i = 0; i < own.n; ++i)
        take[i] |= own.body[i] == w.body;
    }
    else
      w.party == mesh_party ? near_mesh(w, own, mesh, boxes, take) : near_particles(w, own, boxes, take);
  for (const auto &[name, seam] : seams_)
    near_facets(seam.body, seam.facets, seam.reach, own, mesh, boxes, take);
  return take;
}

template <int dim>
void CommonParticles<dim>::near_mesh(const Attention &w, const Surface<dim> &own, const Surface<dim> &mesh,
                                     const Boxes &boxes, std::vector<char> &take) const
{
  std::vector<Facet> facets;
  for (const auto &facet : mesh.facets)
    if (facet.body == w.other)
      facets.push_back(facet);
  near_facets(w.body, facets, w.reach, own, mesh, boxes, take);
}

template <int dim>
void CommonParticles<dim>::near_facets(int body, const std::vector<Facet> &facets, double reach,
                                       const Surface<dim> &own, const Surface<dim> &mesh, const Boxes &boxes,
                                       std::vector<char> &take) const
{
  const double          far = reach + slack_;
  std::vector<Box<dim>> around(facets.size());
  Box<dim>              all;
  for (std::size_t f = 0; f < facets.size(); ++f)
  {
    for (const std::uint32_t i : facets[f].node)
      around[f].include(place_of<dim>(mesh, i));
    around[f].inflate(far);
    all.include(around[f].lower);
    all.include(around[f].upper);
  }
  MarkedCells<dim> cells(common_part(all, boxes[static_cast<std::size_t>(body)]), fine * far);
  for (const auto &box : around)
    cells.mark(box);
  for (std::size_t i = 0; i < own.n; ++i)
    if (!take[i] && own.body[i] == body)
      take[i] = cells.marked(place_of<dim>(own, i));
}

template <int dim>
void CommonParticles<dim>::near_particles(const Attention &w, const Surface<dim> &own, const Boxes &boxes,
                                          std::vector<char> &take) const
{
  const double far  = w.reach + slack_;
  Box<dim>     each[2] = {boxes[static_cast<std::size_t>(w.body)], boxes[static_cast<std::size_t>(w.other)]};
  for (auto &box : each)
    box.inflate(far);
  MarkedCells<dim>           cells(common_part(each[0], each[1]), far);
  std::vector<std::uint32_t> held;
  for (std::size_t i = 0; i < own.n; ++i)
    if (const Point<dim> p = place_of<dim>(own, i); own.body[i] == w.other && cells.holds(p))
      held.push_back(cells.cell(p));
  std::sort(held.begin(), held.end());
  held.erase(std::unique(held.begin(), held.end()), held.end());
  for (const std::uint32_t cell : ranks_.gather(held))
    cells.mark_around(cell);
  for (std::size_t i = 0; i < own.n; ++i)
    if (!take[i] && own.body[i] == w.body)
      take[i] = cells.marked(place_of<dim>(own, i));
}

#define OGIVE_INSTANTIATE(d)                                                                                 \
  template void CommonParticles<d>::attend(std::vector<Attention>);                                          \
  template void CommonParticles<d>::attend_seam(const std::string &, NearSeam);                                \
  template void CommonParticles<d>::set_slack();                                                            \
  template bool CommonParticles<d>::idle() const;                                                           \
  template bool CommonParticles<d>::moved(const Surface<d> &, const Surface<d> &) const;                     \
  template void CommonParticles<d>::note_places(const Surface<d> &, const Surface<d> &);                     \
  template auto CommonParticles<d>::body_boxes(const Surface<d> &) const->Boxes;                             \
  template std::vector<char> CommonParticles<d>::chosen(const Surface<d> &, const Surface<d> &) const;       \
  template void CommonParticles<d>::near_mesh(const Attention &, const Surface<d> &, const Surface<d> &,     \
                                              const Boxes &, std::vector<char> &) const;                     \
  template void CommonParticles<d>::near_facets(int, const std::vector<Facet> &, double, const Surface<d> &, \
                                                const Surface<d> &, const Boxes &, std::vector<char> &) const; \
  template void CommonParticles<d>::near_particles(const Attention &, const Surface<d> &, const Boxes &,     \
                                                   std::vector<char> &) const;
OGIVE_INSTANTIATE(1)
OGIVE_INSTANTIATE(2)
OGIVE_INSTANTIATE(3)
#undef OGIVE_INSTANTIATE
} // namespace ogive::coupling
