// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/known_names.h>
#include <quoin/base/named_sections.h>
#include <quoin/base/number_text.h>
#include <quoin/base/parameter_entries.h>
#include <quoin/farfield/boundary_parameters.h>
#include <quoin/signals/signal_text.h>

#include <algorithm>
#include <cmath>

namespace quoin
{
  namespace
  {
    using constants::degree;

    SpaceTimeFunction function(const ParameterSection &section,
                               const std::string &name, const std::string &text)
    {
      return section.made(
          name, [&]() { return SpaceTimeFunction(text, section.folder()); });
    }

    /** "traction EXPRESSION" or "displacement EXPRESSION". */
    void read_condition(const ParameterSection &section,
                        const std::string &name, bool &traction_is_given,
                        SpaceTimeFunction &value)
    {
      const std::string text = section.text(name);
      for (const std::string word : { "traction", "displacement" })
        if (text.rfind(word + " ", 0) == 0)
        {
          traction_is_given       = word == "traction";
          const std::string given = text.substr(word.size());
          value                   = function(section, name, given);
          const std::string why
              = traction_is_given ? "" : other_motion_text(given, 0);
          if (!why.empty())
            section.fail(name, why + ".");
          return;
        }
      section.fail(name, "must begin with 'traction' or 'displacement', before "
                         "an expression of x, y and t.");
    }

    /** "x, y; x, y; ..." */
    std::vector<std::array<double, 2>> points(const ParameterSection &section,
                                              const std::string &name)
    {
      std::vector<std::array<double, 2>> result;
      for (const auto &row :
           number_rows(section, name, 2,
                       "must be points of two numbers, as in 0, 0; 1, 0; 1, "
                       "2."))
      {
        const std::array<double, 2> point{ { row[0], row[1] } };
        if (!result.empty() && result.back() == point)
          section.fail(name, "repeats the point '" + number_text(point[0])
                                 + ", " + number_text(point[1])
                                 + "': give it once.");
        result.push_back(point);
      }
      return result;
    }

    void check_angles(const ParameterSection &section,
                      const std::array<double, 2> &degrees)
    {
      const double span = std::abs(degrees[1] - degrees[0]);
      if (!(span > 0. && span < 360.))
        section.fail("Angles", "must differ by more than 0 and less than "
                               "360 degrees: an arc has two ends.");
    }

    void check_points(const ParameterSection &section,
                      const BoundaryCurveParameters &boundary)
    {
      const bool closed       = boundary.shape == BoundaryShape::polygon;
      const std::size_t least = closed ? 3 : 2;
      if (closed && boundary.points.size() > 1
          && boundary.points.front() == boundary.points.back())
        section.fail("Points", "ends where it begins: a polygon is closed by "
                               "itself, leave the last point out.");
      if (boundary.points.size() < least)
        section.fail("Points",
                     closed ? "must list at least three corners of a polygon."
                            : "must list at least two points of a line.");
    }

    void check_domain(const ParameterSection &section,
                      const BoundaryCurveParameters &boundary)
    {
      using Shape             = BoundaryShape;
      const bool by_direction = boundary.domain == DomainSide::left
                                || boundary.domain == DomainSide::right;
      if (by_direction
          && (boundary.shape == Shape::circle
              || boundary.shape == Shape::polygon))
        section.fail("Domain", "is for open boundaries: a closed one takes "
                               "'inside' or 'outside'.");
      if (!by_direction
          && (boundary.shape == Shape::line || boundary.shape == Shape::arc))
        section.fail("Domain", "is for closed boundaries: an open one takes "
                               "'left' or 'right' of its direction.");
    }

    void enter_shape(ParameterEntries &entries,
                     BoundaryCurveParameters &boundary)
    {
      using Shape = BoundaryShape;
      entries.choice("Shape", boundary.shape,
                     { { "circle", Shape::circle },
                       { "polygon", Shape::polygon },
                       { "line", Shape::line },
                       { "arc", Shape::arc },
                       { "mesh", Shape::mesh },
                       { "interface", Shape::interface } },
                     "Shape of the boundary. Closed: circle, polygon. Open: "
                     "line (through several points), arc. mesh: physical "
                     "curves of the mesh file, closed or open. interface: "
                     "physical curves along blocks that move with the boundary "
                     "elements, each of which spans whole edges of blocks.");
      const ParameterSection *section = entries.read_section();
      const Shape shape               = boundary.shape;
      if (entries.reads_if(shape == Shape::circle || shape == Shape::arc))
      {
        std::array<double, 2> degrees{ { 0., 360. } };
        entries.numbers("Centre", boundary.centre,
                        "Centre x, y of a circle or an arc [m]");
        entries.positive("Radius", boundary.radius,
                         "Radius of a circle or an arc [m]");
        entries.numbers(
            "Angles", degrees,
            "Angles at which an arc begins and ends, anticlockwise from the x "
            "axis; its direction is from the first to the second. A vertex of "
            "a circle lies at the first angle [deg]");
        if (section && shape == Shape::arc)
          check_angles(*section, degrees);
        boundary.angles = { { degrees[0] * degree, degrees[1] * degree } };
      }
      if (entries.reads_if(shape == Shape::polygon || shape == Shape::line))
        entries.other("Points", "",
                      "Corners of a polygon, or points of a line in its "
                      "direction, as x, y; x, y; ... [m]",
                      [&](const ParameterSection &from)
                      {
                        boundary.points = points(from, "Points");
                        check_points(from, boundary);
                      });
      if (entries.reads_if(shape == Shape::mesh || shape == Shape::interface))
      {
        entries.list(
            "Curves", boundary.curves,
            "Physical curves of the shapes 'mesh' and 'interface', which are "
            "joined end to end in the direction of the first one.");
        if (section && boundary.curves.empty())
          section->fail("Curves",
                        "must name physical curves of the file in section "
                        "'Mesh'.");
      }
      entries.choice(
          "Domain", boundary.domain,
          { { "inside", DomainSide::inside },
            { "outside", DomainSide::outside },
            { "left", DomainSide::left },
            { "right", DomainSide::right } },
          "Side on which the domain lies: inside or outside a closed boundary, "
          "left or right of the direction of an open one.");
      if (section)
        check_domain(*section, boundary);
    }

    void check_elements(const ParameterSection &section,
                        const BoundaryCurveParameters &boundary)
    {
      if (boundary.grading != 1. && boundary.shape != BoundaryShape::arc
          && !(boundary.shape == BoundaryShape::line
               && boundary.points.size() == 2))
        section.fail("Grading", "is for arcs and for lines with two points: "
                                "leave it at 1, or make several lines that "
                                "meet end to end.");
      if (boundary.polygon != CirclePolygon::inscribed
          && boundary.shape != BoundaryShape::circle)
        section.fail("Area", "is for circles only: leave it at 'polygon'.");
      if (boundary.shape == BoundaryShape::circle && boundary.n_elements > 0
          && boundary.n_elements < 3)
        section.fail("Elements", "must be at least 3 on a circle.");
    }

    void check_values(const ParameterSection &section,
                      const BoundaryCurveParameters &boundary)
    {
      if (boundary.shape == BoundaryShape::interface)
        for (const std::string name : { "Horizontal", "Vertical", "Pressure" })
          if (section.text(name) != (name == "Pressure" ? "0" : "traction 0"))
            section.fail(name, "is given, but the blocks move an interface: "
                               "remove it.");
      const bool has_pressure = section.text("Pressure") != "0";
      if (has_pressure && !boundary.traction_is_given[0]
          && !boundary.traction_is_given[1])
        section.fail("Pressure", "has nothing to act on where both "
                                 "displacements are given: remove it, or give "
                                 "a traction.");
    }

    void enter_curve(ParameterEntries &entries,
                     BoundaryCurveParameters &boundary)
    {
      enter_shape(entries, boundary);
      entries.integer("Elements", boundary.n_elements, 0,
                      "Number of elements of this boundary, at most 20000 on "
                      "all boundaries together; 0: "
                      "from the element length [-]",
                      1000000);
      entries.nonnegative(
          "Element length", boundary.element_length,
          "Longest element or, if elements are graded, the shortest one; "
          "those of an interface span whole edges of the blocks, and with "
          "several are up to a fifth longer; 0: 'Element length' of section "
          "'Boundary elements', and if that is 0 as well, the edges of the "
          "mesh [m]");
      entries.within(
          "Grading", boundary.grading, 1e-6, 1e6,
          "Ratio of the length of the last element to that of the first one of "
          "an arc or a line with two points, from 1e-6 to 1e6 [-]");
      entries.choice(
          "Area", boundary.polygon,
          { { "polygon", CirclePolygon::inscribed },
            { "equal", CirclePolygon::equal_area },
            { "equal perimeter", CirclePolygon::equal_perimeter } },
          "Polygon that approximates a circle. polygon: its vertices are on "
          "the circle; equal: it has the area of the circle; equal perimeter: "
          "it has the perimeter of the circle, which is most accurate.");
      const ParameterSection *section = entries.read_section();
      if (section)
        check_elements(*section, boundary);
      const std::string directions[] = { "Horizontal", "Vertical" };
      for (const unsigned int d : { 0, 1 })
        entries.other(directions[d], "traction 0",
                      directions[d]
                          + " component of the boundary values: 'traction' "
                            "[Pa] or 'displacement' [m], followed by an "
                            "expression of x, y, t [m, s], or by 'table FILE' "
                            "or a signal, alone or with 'times EXPRESSION'.",
                      [&](const ParameterSection &from)
                      {
                        bool is_traction = true;
                        read_condition(from, directions[d], is_traction,
                                       boundary.value[d]);
                        boundary.traction_is_given[d] = is_traction;
                      });
      entries.other("Pressure", "0",
                    "Pressure that pushes on the domain and is added to "
                    "prescribed tractions: an expression of x, y, t [m, s], "
                    "'table FILE' or a signal [Pa]",
                    [&](const ParameterSection &from) {
                      boundary.pressure
                          = function(from, "Pressure", from.text("Pressure"));
                    });
      if (section)
        check_values(*section, boundary);
      if (section && boundary.shape == BoundaryShape::interface)
        boundary.traction_is_given = { { false, false } };
    }

    void check_box(const ParameterSection &section,
                   const SampledFieldParameters &field)
    {
      if (!(field.box[0] < field.box[2] && field.box[1] < field.box[3]))
        section.fail("Box", "must be xmin, ymin, xmax, ymax with xmin < xmax "
                            "and ymin < ymax.");
      const double n_points
          = (1. + (field.box[2] - field.box[0]) / field.spacing)
            * (1. + (field.box[3] - field.box[1]) / field.spacing);
      if (n_points > 1e6)
        section.fail("Spacing",
                     text_of("makes ", n_points,
                             " points, more than a million: give a larger "
                             "one."));
    }

    void enter_field(ParameterEntries &entries, SampledFieldParameters &field)
    {
      entries.other(
          "Box", "",
          "Rectangle xmin, ymin, xmax, ymax in which the field is computed at "
          "the end of the run, for field.pvd; empty: no field [m]",
          [&](const ParameterSection &from)
          {
            field.has_box = !from.text("Box").empty();
            if (field.has_box)
              field.box = from.numbers<4>("Box");
          });
      if (entries.reads_if(field.has_box))
        entries.positive("Spacing", field.spacing,
                         "Spacing of the points of the sampled field [m]");
      if (entries.read_section() && field.has_box)
        check_box(*entries.read_section(), field);
    }

    void check_analysis(const ParameterSection &section,
                        const BoundaryElementParameters &parameters)
    {
      const bool quadrature
          = parameters.formulation == Formulation::convolution_quadrature;
      if (parameters.highest_frequency > 0. && parameters.element_length > 0.)
        section.fail("Highest frequency", "gives the elements' length, as "
                                          "'Element length' does: leave one of "
                                          "them at 0.");
      if (parameters.is_static && parameters.decay > 0.)
        section.fail("Decay", "has no meaning with 'Analysis = static': remove "
                              "it.");
      if (quadrature && parameters.decay > 0.)
        section.fail("Decay", "is not for convolution quadrature: use 'Mass "
                              "damping' and 'Stiffness damping'.");
      for (const std::string name : { "Mass damping", "Stiffness damping" })
        if (!quadrature && section.number(name) > 0.)
          section.fail(name, "needs 'Formulation = convolution quadrature'; "
                             "other formulations take 'Decay'.");
      if (parameters.is_static && quadrature)
        section.fail("Formulation", "has no statics: use Galerkin or "
                                    "collocation.");
    }

    /** Without blocks the section says how long the run takes. */
    void check_coupling(const ParameterSection &section,
                        const BoundaryElementParameters &parameters,
                        const bool coupled)
    {
      if (!coupled && parameters.coupling != CouplingScheme::implicit)
        section.fail("Coupling", "has no meaning without blocks: remove it.");
      if (!coupled && !parameters.is_static)
        section.positive("Duration");
      if (coupled && parameters.is_static)
        section.fail("Analysis", "is that of a domain without blocks: leave it "
                                 "at 'dynamic'.");
      if (coupled && parameters.duration > 0.)
        section.fail("Duration", "has no meaning here: the stages say how long "
                                 "the run takes. Remove it.");
    }

    void enter_time(ParameterEntries &entries,
                    BoundaryElementParameters &parameters)
    {
      entries.nonnegative(
          "Step ratio", parameters.step_ratio,
          "Ratio of c_1 times the time step to the length of the shortest "
          "element, used if 'Time step' is 0; 0: automatic, 1 or, if elements "
          "differ in length or Poisson's ratio is above 0.25, as much as makes "
          "c_2 times the time step 0.58 of the longest, at most 1.5; with "
          "convolution quadrature 0.5 [-]");
      entries.nonnegative(
          "Time step", parameters.time_step,
          "Time step of the boundary elements, which is shortened so that the "
          "run ends at a step; 0: from 'Step ratio' [s]");
      entries.nonnegative("Duration", parameters.duration,
                          "Duration of a run with 'Model = boundary elements' "
                          "[s]");
      entries.choice(
          "Coupling", parameters.coupling,
          { { "implicit", CouplingScheme::implicit },
            { "staggered", CouplingScheme::staggered } },
          "Coupling of blocks and boundary elements. implicit: the impedance "
          "of the newest boundary element step acts on the interface nodes "
          "implicitly in each block step, and does not lower the critical time "
          "step; staggered: extrapolated displacements as in Jin, Wang & "
          "Zhang, which is often unstable.");
      entries.nonnegative(
          "Decay", parameters.decay,
          "Decay rate of both kernels of Galerkin and collocation [1/s]");
      entries.nonnegative("Mass damping", parameters.damping.mass,
                          "Mass-proportional coefficient of Rayleigh damping, "
                          "for convolution quadrature only [1/s]");
      entries.nonnegative("Stiffness damping", parameters.damping.stiffness,
                          "Stiffness-proportional coefficient of Rayleigh "
                          "damping, for convolution quadrature only [s]");
    }

    void enter_section(ParameterEntries &entries,
                       BoundaryElementParameters &parameters)
    {
      entries.text("Material", parameters.material,
                   "Material of the domain; empty: the only material of the "
                   "file. A Mohr-Coulomb material has its elastic constants "
                   "there and does not yield.");
      entries.choice(
          "Formulation", parameters.formulation,
          { { "Galerkin", Formulation::galerkin },
            { "collocation", Formulation::collocation },
            { "convolution quadrature", Formulation::convolution_quadrature } },
          "Formulation of the boundary integral equation. Galerkin: weighted "
          "over each element; collocation: at the middle of each element, both "
          "with tractions and velocities constant in each time step; "
          "convolution quadrature: Galerkin in space with convolution "
          "quadrature in time.");
      entries.choice("Analysis", parameters.is_static,
                     { { "dynamic", false }, { "static", true } },
                     "Analysis of boundary elements alone. dynamic: time "
                     "marching; static: one elastostatic solution for the "
                     "boundary values at t = 'Duration'.");
      entries.nonnegative("Element length", parameters.element_length,
                          "Longest element of boundaries without an 'Element "
                          "length' of their own [m]");
      entries.nonnegative(
          "Highest frequency", parameters.highest_frequency,
          "Highest frequency of waves to be resolved: the 'Element length' "
          "becomes a tenth of the S wavelength at this frequency; 0: 'Element "
          "length' is given [Hz]");
      enter_time(entries, parameters);
      entries.choice("History", parameters.direct_history,
                     { { "compressed", false }, { "direct", true } },
                     "Summation of the convolution over past steps. "
                     "compressed: at bounded cost per step; direct: term by "
                     "term, at a cost that grows with the number of steps.");
      entries.within("Tolerance", parameters.tolerance, 1e-12, 1e-2,
                     "Relative error of the compressed convolution [-]");
      entries.integer("Passivity frequencies", parameters.n_frequencies, 0,
                      "Number of frequencies at which the passivity of the "
                      "boundary is checked before the run; 0: no check [-]",
                      100000);
      if (const ParameterSection *section = entries.read_section())
        check_analysis(*section, parameters);
    }
  } // namespace

  void BoundaryCurveParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_curve);
  }

  BoundaryCurveParameters
  BoundaryCurveParameters::read(const ParameterSection &section,
                                const std::string &name)
  {
    BoundaryCurveParameters boundary = read_entries(section, enter_curve);
    boundary.name                    = name;
    return boundary;
  }

  void SampledFieldParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_field);
  }

  SampledFieldParameters
  SampledFieldParameters::read(const ParameterSection &section)
  {
    return read_entries(section, enter_field);
  }

  void BoundaryElementParameters::declare(dealii::ParameterHandler &prm)
  {
    declare_entries(prm, enter_section);
  }

  namespace
  {
    /** The medium of the domain, from the material that is named. */
    void find_medium(const ParameterSection &section,
                     const std::vector<MaterialParameters> &materials,
                     const bool coupled, BoundaryElementParameters &boundary)
    {
      if (boundary.material.empty() && materials.size() == 1)
        boundary.material = materials.front().name;
      const MaterialParameters *material
          = find_named(materials, boundary.material);
      if (material == nullptr)
        section.fail("Material", "is no material: name one of the 'Names' of "
                                 "section 'Materials'.");
      if (material->rigid)
        section.fail("Material", "leads to '" + material->name
                                     + "', which is rigid: boundary elements "
                                       "need 'Law = linear elastic'.");
      if (material->strength && !coupled)
        section.fail("Material", "leads to '" + material->name
                                     + "', whose law is Mohr-Coulomb: "
                                       "boundary elements alone are elastic, "
                                       "they need 'Law = linear elastic'.");
      boundary.medium = ElasticMedium::from_young(material->elastic.density,
                                                  material->elastic.young,
                                                  material->elastic.poisson);
    }

    /** Sizes of elements and steps that are left to the program. */
    void choose_resolution(const ParameterSection &section,
                           BoundaryElementParameters &boundary)
    {
      const ElasticMedium &medium = boundary.medium;
      if (boundary.highest_frequency > 0.)
        boundary.element_length = medium.c2 / boundary.highest_frequency / 10.;
      for (const BoundaryCurveParameters &curve : boundary.boundaries)
        if (curve.shape != BoundaryShape::mesh
            && curve.shape != BoundaryShape::interface && curve.n_elements == 0
            && curve.element_length == 0. && boundary.element_length == 0.)
          ParameterSection(section, curve.name)
              .fail("Elements", "leaves the size of the elements open: give "
                                "their number, an 'Element length' or a "
                                "'Highest frequency'.");
    }
  } // namespace

  BoundaryElementParameters BoundaryElementParameters::read(
      const ParameterSection &top,
      const std::vector<MaterialParameters> &materials, const bool coupled)
  {
    BoundaryElementParameters parameters;
    {
      const ParameterSection section(top, "Boundary elements");
      parameters = read_entries(section, enter_section);
      check_coupling(section, parameters, coupled);
    }
    parameters.boundaries
        = read_named<BoundaryCurveParameters>(top, "Boundary elements");
    parameters.waves
        = read_named<IncidentWaveParameters>(top, "Incident waves");
    parameters.sampled_field
        = SampledFieldParameters::read(ParameterSection(top, "Sampled field"));
    const ParameterSection section(top, "Boundary elements");
    if (parameters.boundaries.empty())
      section.fail("Names", "must list at least one boundary.");
    find_medium(section, materials, coupled, parameters);
    choose_resolution(section, parameters);
    return parameters;
  }

  bool BoundaryElementParameters::has(const BoundaryShape shape) const
  {
    return std::any_of(boundaries.begin(), boundaries.end(),
                       [=](const BoundaryCurveParameters &curve)
                       { return curve.shape == shape; });
  }

  std::vector<std::string> BoundaryElementParameters::interface_curves() const
  {
    std::vector<std::string> result;
    for (const BoundaryCurveParameters &curve : boundaries)
      if (curve.shape == BoundaryShape::interface)
        result.insert(result.end(), curve.curves.begin(), curve.curves.end());
    return result;
  }

  double
  BoundaryElementParameters::wanted_time_step(const Boundary &boundary) const
  {
    if (time_step > 0.)
      return time_step;
    const double shortest = boundary.lengths().minCoeff(),
                 longest  = boundary.lengths().maxCoeff();
    double ratio          = step_ratio;
    // Where the discrete operators are passive, or nearly so, and accurate: of
    // elements that are crossed in a small share of a step tractions that are
    // given may feed what grows slowly.
    if (ratio == 0.)
      ratio = formulation == Formulation::convolution_quadrature
                  ? 0.5
                  : std::clamp(medium.c1 / (std::sqrt(3.) * medium.c2) * longest
                                   / shortest,
                               1., 1.5);
    return ratio * shortest / medium.c1;
  }

  FormulationOptions BoundaryElementParameters::formulation_options() const
  {
    FormulationOptions options;
    options.formulation    = formulation;
    options.decay          = decay;
    options.damping        = damping;
    options.direct_history = direct_history;
    options.tolerance      = tolerance;
    return options;
  }
} // namespace quoin
