// SPDX-License-Identifier: LGPL-2.1-or-later
#include "core/input/scene_fields.h"

namespace ogive::input
{
namespace
{
void sph_fields(Fields &f, SphOptions &o)
{
  f.choice({"form", "discrete form of the equations"}, o.form, {"standard", "corrected"});
  f.choice({"configuration", "neighbours, kernel and volumes of the present, or of t = 0 (no numerical fracture; nothing "
                             "may break)"},
           o.configuration, {"current", "reference"});
  f.choice({"kernel", "smoothing kernel"}, o.kernel, {"cubic", "quintic", "wendland-c2", "wendland-c4"});
  f.number({"h over dx", "smoothing length over particle spacing"}, o.h_over_dx, Bound{.8, 2.5});
  f.choice({"density", "density from the velocity gradient, or from the masses around relative to t = 0"}, o.density,
           {"continuity", "summation"});
  f.choice({"viscosity", "artificial viscosity"}, o.viscosity, {"monaghan", "hernquist-katz", "owen"});
  f.number({"alpha", "linear coefficient of the viscosity"}, o.alpha, bounds::not_negative);
  f.number({"beta", "quadratic coefficient of the viscosity"}, o.beta, bounds::not_negative);
  f.choice({"limiter", "weak viscosity sees the jump that is left of a pair's velocity difference once both ends' "
                       "linear fields are continued to its middle; auto: linear where shock split is sharp or curvature"},
           o.limiter, {"auto", "none", "linear"});
  f.choice({"switch", "factor on the viscosity of each particle"}, o.viscosity_switch,
           {"none", "balsara", "cullen-dehnen", "divergence-gradient"});
  f.choice({"correction", "acceleration correction of the weak viscosity"}, o.correction,
           {"none", "pairwise", "shepard"});
  f.number({"correction support", "support of the correction over the smoothing length; the greatest one where a rule "
                                  "chooses"},
           o.correction_support, Bound{0, 2, true});
  f.choice({"support rule", "how the support of the correction is chosen"}, o.support_rule,
           {"fixed", "total-variation", "minimal-dissipation", "monotonicity"});
  f.choice({"shock split", "sensor of the viscosity that captures shocks; the rest is weak viscosity; auto: curvature "
                           "where there is a correction"},
           o.shock_split, {"auto", "none", "compression", "sharp", "curvature"});
  f.number({"split compression", "h |div v|/c at which shock split = compression leaves all viscosity"},
           o.split_compression, bounds::positive);
  f.number({"split ratio", "unevenness of div v among neighbours at which shock split = sharp or curvature leaves half"},
           o.split_ratio, bounds::positive);
  f.number({"split bend", "unevenness of div v that a linear field leaves, at which shock split = curvature opens half"},
           o.split_bend, bounds::positive);
  f.choice({"energy form", "where the heat of the viscosity goes; shepard needs working (v.<da>) or averaged"},
           o.energy_form, {"compatible", "working", "averaged"});
  f.number({"artificial stress", "coefficient against the tensile instability; 0: none"}, o.artificial_stress,
           bounds::not_negative);
  f.number({"hourglass", "coefficient of the hourglass control"}, o.hourglass, bounds::not_negative);
  f.number({"hourglass stiffness", "modulus of the elastic hourglass control over that of plane waves, in the reference "
                                   "configuration"},
           o.hourglass_stiffness, Bound{0, .5});
  f.number({"step factor", "share of the stability bound; above 1 only to see a run blow up"}, o.step_factor,
           Bound{0, 2, true});
  f.choice({"quiescent skip", "particles that nothing has reached yet are not computed"}, o.quiescent_skip, {"on", "off"});
}

void fem_fields(Fields &f, FemOptions &o)
{
  f.choice({"element", "formulation of elements, unless their body names one"}, o.element,
           {"one-point", "b-bar", "full", "area-weighted", "spectral"});
  f.choice({"degree", "polynomial degree of spectral elements"}, o.degree, {{"2", 2}, {"3", 3}, {"4", 4}});
  f.choice({"hourglass", "kind of hourglass control"}, o.hourglass, {"stiffness", "viscous"});
  f.number({"hourglass coefficient", "coefficient of the hourglass control"}, o.hourglass_coefficient,
           bounds::not_negative);
  f.choice({"bulk viscosity", "formula of the bulk viscosity of elements"}, o.bulk_viscosity,
           {"neumann-richtmyer", "kuropatenko", "none"});
  f.number({"bulk quadratic", "quadratic coefficient of the bulk viscosity"}, o.bulk_quadratic, bounds::not_negative);
  f.number({"bulk linear", "linear coefficient of the bulk viscosity"}, o.bulk_linear, bounds::not_negative);
  f.choice({"correction", "acceleration correction of the bulk viscosity of one-point elements: what neighbours share "
                          "is taken out of it"},
           o.correction, {"none", "pairwise"});
  f.choice({"shock split", "sensor of the viscosity that captures shocks and is not corrected"}, o.shock_split,
           {"none", "compression"});
  f.number({"split compression", "L |div v|/c at which shock split = compression leaves all viscosity"},
           o.split_compression, bounds::positive);
  f.quantity({"mass scaling step", "elements whose undeformed step bound is shorter get the mass, for inertia alone, "
                                   "that lengthens it to this; 0: none"},
             o.mass_scaling_step, units::time, bounds::not_negative);
  f.choice({"step bound", "whose bound: the worst element's, never unsafe, or that of the whole mesh by power "
                          "iteration every 20 steps"},
           o.step_bound, {"element", "power-iteration"});
  f.number({"step factor", "share of the stability bound; above 1 only to see a run blow up"}, o.step_factor,
           Bound{0, 2, true});
  f.choice({"quiescent skip", "elements that nothing has reached yet are not computed"}, o.quiescent_skip, {"on", "off"});
  f.choice({"local steps", "longest step of an element over the shortest: small elements do not hold back the whole mesh; "
                           "auto: the ratio that costs least"},
           o.local_steps, {"none", "auto", "2", "4", "8"});
}

void stop_fields(Fields &f, StopRule &s)
{
  f.text({"body", "the run stops early once the velocity of this body no longer changes"}, s.body,
         "the name of a body");
  f.number({"tolerance", "relative change of the velocity over the window", Need::optional, {"body", {}}}, s.tolerance,
           bounds::positive_fraction);
  f.quantity({"window", "how long the velocity must stay the same", Need::mandatory, {"body", {}}}, s.window,
             units::time, bounds::positive);
  s.active = !s.body.empty();
}
} // namespace

void option_fields(Fields &f, Scene &scene)
{
  f.enter("SPH");
  sph_fields(f, scene.sph);
  f.leave();

  f.enter("FEM");
  fem_fields(f, scene.fem);
  f.leave();

  f.enter("Subcycling");
  f.choice({"who", "the solver that takes several steps in one of the other"}, scene.subcycling.who,
           {"none", "auto", "particles", "elements"});
  const Use somebody{"who", {"particles", "elements"}};
  f.number({"steps", "how many", Need::optional, somebody}, scene.subcycling.steps, Bound{1, 64});
  f.number({"energy limit", "error of the energy over the initial kinetic energy above which both step alike from then on",
            Need::optional, {"who", {"auto", "particles", "elements"}}},
           scene.subcycling.energy_limit, bounds::positive);
  f.leave();

  f.enter("Parallel");
  f.choice({"partition", "how elements are shared among ranks: recursive coordinate bisection, or p4est along the mesh"},
           scene.parallel.partition, {"rcb", "p4est"});
  f.number({"imbalance", "most over mean measured cost of a rank above which the work is shared anew"},
           scene.parallel.imbalance, Bound{1, 100, true});
  f.number({"interval", "steps between looks at it"}, scene.parallel.interval, Bound{1, 1e9});
  f.leave();

  f.enter("Stop");
  stop_fields(f, scene.stop);
  f.leave();

  f.enter("Limits");
  f.number({"energy drift", "relative drift of the energy beyond which the run fails"}, scene.limits.energy_drift,
           bounds::positive);
  f.number({"smallest step ratio", "share of the first step below which the run fails"},
           scene.limits.smallest_step_ratio, Bound{0, 1, true, true});
  f.leave();

  f.enter("Output");
  f.quantity({"history interval", "time between rows of history.csv; 0: a two-hundredth of the end time"},
             scene.output.history_interval, units::time, bounds::not_negative);
  f.quantity({"field interval", "time between stored fields; 0: first and last state only"},
             scene.output.field_interval, units::time, bounds::not_negative);
  f.quantity({"checkpoint interval", "time between checkpoints; 0: last state only"}, scene.output.checkpoint_interval,
             units::time, bounds::not_negative);
  f.leave();
}
} // namespace ogive::input
