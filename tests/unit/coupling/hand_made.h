// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "core/io/archive.h"
#include "coupling/contact.h"
#include "coupling/surfaces.h"

#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

/// Points without material, moved by a leapfrog: enough to see what the
/// coupling layer does to them.
namespace ogive::coupling::hand_made
{
template <int dim>
struct Arrays
{
  std::array<std::vector<double>, dim>      x, v, f;
  std::vector<double>                       mass, radius;
  std::vector<int>                          body;
  std::vector<std::int64_t>                 id;
  std::vector<typename Surface<dim>::Facet> facets;
  std::uint64_t                             topology = 1;

  std::uint32_t add(const Point<dim> &where, const Point<dim> &velocity, double m, int of_body, double r = 0)
  {
    for (int a = 0; a < dim; ++a)
    {
      x[a].push_back(where[a]);
      v[a].push_back(velocity[a]);
      f[a].push_back(0);
    }
    mass.push_back(m);
    radius.push_back(r);
    body.push_back(of_body);
    id.push_back(static_cast<std::int64_t>(id.size()));
    return static_cast<std::uint32_t>(id.size() - 1);
  }

  Surface<dim> surface()
  {
    Surface<dim> s;
    s.n = mass.size();
    for (int a = 0; a < dim; ++a)
    {
      s.x[a]     = x[a];
      s.v[a]     = v[a];
      s.force[a] = f[a];
    }
    s.mass   = mass;
    s.radius = radius;
    s.body   = body;
    s.id     = id;
    for (std::uint32_t i = 0; i < s.n; ++i)
      s.contact_points.push_back(i);
    s.facets   = facets;
    s.topology = topology;
    return s;
  }

  Point<dim> at(const std::array<std::vector<double>, dim> &field, std::size_t i) const
  {
    Point<dim> p;
    for (int a = 0; a < dim; ++a)
      p[a] = field[a][i];
    return p;
  }

  void kick_and_drift(double dt, const Point<dim> &gravity)
  {
    for (int a = 0; a < dim; ++a)
      for (std::size_t i = 0; i < mass.size(); ++i)
      {
        v[a][i] += dt * (f[a][i] / mass[i] + gravity[a]);
        x[a][i] += dt * v[a][i];
        f[a][i] = 0;
      }
  }

  double kinetic() const
  {
    double sum = 0;
    for (std::size_t i = 0; i < mass.size(); ++i)
      sum += .5 * mass[i] * at(v, i).squaredNorm();
    return sum;
  }
  Point<dim> momentum() const
  {
    Point<dim> sum = Point<dim>::Zero();
    for (std::size_t i = 0; i < mass.size(); ++i)
      sum += mass[i] * at(v, i);
    return sum;
  }
};

template <int dim>
struct World
{
  Arrays<dim>                mesh, particles;
  std::vector<std::uint32_t> index_of_id;
  std::vector<double>        damage; ///< of the particles by present index; empty: none
  Point<dim>                 gravity = Point<dim>::Zero();
  double                     time    = 0;

  Faces<dim> look()
  {
    Faces<dim> faces;
    faces.of[mesh_party]     = mesh.surface();
    faces.of[particle_party] = particles.surface();
    index_of_id.resize(particles.id.size());
    for (std::size_t i = 0; i < particles.id.size(); ++i)
      index_of_id[particles.id[i]] = static_cast<std::uint32_t>(i);
    faces.particle_index = index_of_id;
    faces.damage         = damage;
    return faces;
  }

  void step(ContactSet<dim> &contacts, double dt)
  {
    auto faces = look();
    faces.clear_forces();
    contacts.gather(faces);
    mesh.kick_and_drift(dt, Point<dim>::Zero());
    particles.kick_and_drift(dt, gravity);
    contacts.close(look(), {time, dt, dt});
    time += dt;
  }

  double     kinetic() const { return mesh.kinetic() + particles.kinetic(); }
  Point<dim> momentum() const { return mesh.momentum() + particles.momentum(); }
};

/// A rotation that leaves no axis alone.
template <int dim>
Eigen::Matrix<double, dim, dim> tilt()
{
  if constexpr (dim == 1)
    return Eigen::Matrix<double, 1, 1>(1.);
  else if constexpr (dim == 2)
    return Eigen::Rotation2Dd(.7).toRotationMatrix();
  else
    return Eigen::AngleAxisd(1.1, Point<3>(1, -2, .5).normalized()).toRotationMatrix();
}

/// One facet of edge `size` about the origin with its outward normal along the
/// last axis, then turned by `turn`. In one dimension one point.
template <int dim>
void add_plate(Arrays<dim> &mesh, double size, double mass, int body,
               const Eigen::Matrix<double, dim, dim> &turn)
{
  typename Surface<dim>::Facet facet;
  facet.body                                              = body;
  const std::array<std::array<double, 3>, 4> quad         = {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}};
  const std::array<std::array<double, 3>, 4> segment      = {{{1, 0, 0}, {-1, 0, 0}, {}, {}}};
  const std::array<std::array<double, 3>, 4> single_point = {};
  const auto &corners = dim == 3 ? quad : dim == 2 ? segment : single_point;
  for (std::size_t k = 0; k < facet.node.size(); ++k)
  {
    Point<dim> p;
    for (int a = 0; a < dim; ++a)
      p[a] = .5 * size * corners[k][a];
    facet.node[k] =
      mesh.add(turn * p, Point<dim>::Zero(), mass / static_cast<double>(facet.node.size()), body);
  }
  mesh.facets.push_back(facet);
}

/// The closed surface of a box from -half to half, n facets an edge.
inline void add_box(Arrays<3> &mesh, const Point<3> &half, int n, double node_mass, int body)
{
  std::map<std::array<int, 3>, std::uint32_t> nodes;
  const auto                                  node = [&](const std::array<int, 3> &at) {
    const auto found = nodes.find(at);
    if (found != nodes.end())
      return found->second;
    Point<3> p;
    for (int a = 0; a < 3; ++a)
      p[a] = half[a] * (2. * at[a] / n - 1);
    return nodes[at] = mesh.add(p, Point<3>::Zero(), node_mass, body);
  };
  for (int a = 0; a < 3; ++a)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
          Surface<3>::Facet  facet;
          const int          b = (a + 1) % 3, c = (a + 2) % 3;
          const int          order[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
          for (int k = 0; k < 4; ++k)
          {
            const int         *o = order[side == 1 ? k : 3 - k];
            std::array<int, 3> at{};
            at[a]         = side * n;
            at[b]         = i + o[0];
            at[c]         = j + o[1];
            facet.node[k] = node(at);
          }
          facet.body    = body;
          facet.element = static_cast<std::uint32_t>(mesh.facets.size()); // an element behind each
          mesh.facets.push_back(facet);
        }
}

class MemoryArchive : public ArchiveWriter, public ArchiveReader
{
public:
  using ArchiveWriter::write;
  void write(const std::string &name, std::span<const double> values) override
  {
    doubles_[name].assign(values.begin(), values.end());
  }
  void write(const std::string &name, std::span<const std::int64_t> values) override
  {
    integers_[name].assign(values.begin(), values.end());
  }
  std::vector<double>       doubles(const std::string &name) const override { return doubles_.at(name); }
  std::vector<std::int64_t> integers(const std::string &name) const override { return integers_.at(name); }

private:
  std::map<std::string, std::vector<double>>       doubles_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};
} // namespace ogive::coupling::hand_made
