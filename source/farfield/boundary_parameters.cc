// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/farfield/boundary_parameters.h>
#include <quoin/base/constants.h>
#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>

#include <cmath>
#include <sstream>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;
    using dealii::Patterns::Integer;
    using dealii::Patterns::Selection;

    using constants::degree;

    SpaceTimeFunction function(const ParameterSection &section,
                               const std::string &name, const std::string &text)
    {
      try
      {
        return SpaceTimeFunction(text, section.folder());
      }
      catch (const InputError &error)
      {
        section.fail(name, error.what());
      }
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
          traction_is_given = word == "traction";
          value             = function(section, name, text.substr(word.size()));
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
           section.rows(name, 2,
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

    const std::vector<std::pair<std::string, BoundaryShape>> shapes
        = { { "circle", BoundaryShape::circle },
            { "polygon", BoundaryShape::polygon },
            { "line", BoundaryShape::line },
            { "arc", BoundaryShape::arc },
            { "mesh", BoundaryShape::mesh },
            { "interface", BoundaryShape::interface } };

    void read_shape(const ParameterSection &section,
                    BoundaryCurveParameters &boundary)
    {
      using Shape    = BoundaryShape;
      boundary.shape = section.choice<Shape>("Shape", shapes);
      switch (boundary.shape)
      {
      case Shape::circle:
      case Shape::arc:
        boundary.centre = section.numbers<2>("Centre");
        boundary.radius = section.positive("Radius");
        boundary.angles = section.numbers<2>("Angles");
        if (boundary.shape == Shape::arc)
        {
          const double span = std::abs(boundary.angles[1] - boundary.angles[0]);
          if (!(span > 0. && span < 360.))
            section.fail("Angles", "must differ by more than 0 and less than "
                                   "360 degrees: an arc has two ends.");
        }
        for (double &angle : boundary.angles)
          angle *= degree;
        break;
      case Shape::polygon:
      case Shape::line:
      {
        boundary.points         = points(section, "Points");
        const bool closed       = boundary.shape == Shape::polygon;
        const std::size_t least = closed ? 3 : 2;
        if (closed && boundary.points.size() > 1
            && boundary.points.front() == boundary.points.back())
          section.fail("Points", "ends where it begins: a polygon is closed by "
                                 "itself, leave the last point out.");
        if (boundary.points.size() < least)
          section.fail("Points",
                       closed ? "must list at least three corners of a polygon."
                              : "must list at least two points of a line.");
        break;
      }
      case Shape::mesh:
      case Shape::interface:
        boundary.curves = section.list("Curves");
        if (boundary.curves.empty())
          section.fail("Curves",
                       "must name physical curves of the file in section "
                       "'Mesh'.");
        break;
      }

      boundary.domain = section.choice<DomainSide>(
          "Domain", { { "inside", DomainSide::inside },
                      { "outside", DomainSide::outside },
                      { "left", DomainSide::left },
                      { "right", DomainSide::right } });
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
  } // namespace

  void BoundaryCurveParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Shape", "circle",
                      Selection("circle|polygon|line|arc|mesh|interface"),
                      "Closed: circle, polygon. Open: line (through several "
                      "points), arc. Mesh: curves of the mesh file, closed or "
                      "open. Interface: the same, along blocks that move with "
                      "the boundary elements; each element spans whole edges "
                      "of blocks.");
    prm.declare_entry("Centre", "0, 0", Anything(),
                      "Circle, arc: x, y of the centre [m]");
    prm.declare_entry("Radius", "0", Double(), "Circle, arc [m]");
    prm.declare_entry("Angles", "0, 360", Anything(),
                      "Arc: from, to, anticlockwise from the x axis; its "
                      "direction is from the first to the second. Circle: the "
                      "first is the place of a vertex [deg]");
    prm.declare_entry("Points", "", Anything(),
                      "Polygon: its corners; line: its points, in its "
                      "direction; as x, y; x, y; ... [m]");
    prm.declare_entry(
        "Curves", "", Anything(),
        "Mesh, interface: physical curves, joined end to end; the "
        "first one "
        "gives the direction.");
    prm.declare_entry("Domain", "outside",
                      Selection("inside|outside|left|right"),
                      "Where the domain is: inside or outside a closed "
                      "boundary, left or right of the direction of an open "
                      "one.");
    prm.declare_entry("Elements", "0", Integer(0, 1000000),
                      "Number of elements, 20000 on all boundaries at most; "
                      "0: from the element length.");
    prm.declare_entry("Element length", "0", Double(),
                      "No element is longer; if they are graded, of the "
                      "shortest; 0: that of the section, and if that is 0, "
                      "too, the edges of the mesh [m]");
    prm.declare_entry("Grading", "1", Double(),
                      "Arc, line with two points: length of the last element "
                      "by that of the first one, 1e-6 to 1e6 [-]");
    prm.declare_entry("Area", "polygon",
                      Selection("polygon|equal|equal perimeter"),
                      "Circle: a polygon with vertices on the circle, with "
                      "the area of the circle, or, most exact, with its "
                      "perimeter.");
    for (const std::string direction : { "Horizontal", "Vertical" })
      prm.declare_entry(direction, "traction 0", Anything(),
                        "What is given: 'traction' [Pa] or 'displacement' [m] "
                        "and an expression of x, y, t [m, s]; or 'table FILE' "
                        "or a signal, alone or 'times EXPRESSION'.");
    prm.declare_entry("Pressure", "0", Anything(),
                      "Expression as above; pushes on the domain and adds to "
                      "given tractions [Pa]");
  }

  BoundaryCurveParameters
  BoundaryCurveParameters::read(const ParameterSection &section,
                                const std::string &name)
  {
    BoundaryCurveParameters boundary;
    boundary.name = name;
    read_shape(section, boundary);
    boundary.n_elements     = section.integer("Elements");
    boundary.element_length = section.nonnegative("Element length");
    boundary.grading        = section.within("Grading", 1e-6, 1e6);
    if (boundary.grading != 1. && boundary.shape != BoundaryShape::arc
        && !(boundary.shape == BoundaryShape::line
             && boundary.points.size() == 2))
      section.fail("Grading", "is for arcs and for lines with two points: "
                              "leave it at 1, or make several lines that meet "
                              "end to end.");
    boundary.polygon = section.choice<CirclePolygon>(
        "Area", { { "polygon", CirclePolygon::inscribed },
                  { "equal", CirclePolygon::equal_area },
                  { "equal perimeter", CirclePolygon::equal_perimeter } });
    if (boundary.polygon != CirclePolygon::inscribed
        && boundary.shape != BoundaryShape::circle)
      section.fail("Area", "is for circles only: leave it at 'polygon'.");
    if (boundary.shape == BoundaryShape::circle && boundary.n_elements > 0
        && boundary.n_elements < 3)
      section.fail("Elements", "must be at least 3 on a circle.");
    read_condition(section, "Horizontal", boundary.traction_is_given[0],
                   boundary.value[0]);
    read_condition(section, "Vertical", boundary.traction_is_given[1],
                   boundary.value[1]);
    boundary.pressure = function(section, "Pressure", section.text("Pressure"));
    if (boundary.shape == BoundaryShape::interface)
    {
      for (const std::string name : { "Horizontal", "Vertical", "Pressure" })
        if (section.text(name) != (name == "Pressure" ? "0" : "traction 0"))
          section.fail(name, "is given, but the blocks move an interface: "
                             "remove it.");
      boundary.traction_is_given = { { false, false } };
    }
    const bool has_pressure = section.text("Pressure") != "0";
    if (has_pressure && !boundary.traction_is_given[0]
        && !boundary.traction_is_given[1])
      section.fail("Pressure", "has nothing to act on where both displacements "
                               "are given: remove it, or give a traction.");
    return boundary;
  }

  void IncidentWaveParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Type", "plane P",
                      Selection("plane P|plane SV|Rayleigh|line source"),
                      "Plane P: motion along the direction of propagation; "
                      "plane SV: across it; Rayleigh: along the free surface; "
                      "line source: an explosion in the domain.");
    prm.declare_entry("Space", "full plane", Selection("full plane|half-plane"),
                      "Half-plane: the medium is below y = 0, where the wave "
                      "is reflected; no boundary may be above. Rayleigh waves "
                      "need it, line sources must not have it.");
    prm.declare_entry("Angle", "0", Double(),
                      "Direction of propagation, from the upward vertical "
                      "towards +x; Rayleigh: 90 or -90 [deg]");
    prm.declare_entry("Position", "0, 0", Anything(), "Line source: x, y [m]");
    prm.declare_entry("Signal", "", Anything(),
                      "Function of t [s]: motion of the incident wave at the "
                      "origin, vertical if it is a Rayleigh wave; moment per "
                      "length of a line source. Expression, table, wavelet, "
                      "pulse, record or synthetic; 0 before the wave's start.");
    prm.declare_entry("Motion", "displacement",
                      Selection("displacement|velocity|acceleration"),
                      "What 'Signal' is; integrated from t = 0 on, or in "
                      "closed form. A moment is not integrated.");
    prm.declare_entry("Amplitude", "1", Double(),
                      "Factor of the signal [m, m/s, m/s^2; line source: N]");
    prm.declare_entry("Displacement", "0", Anything(),
                      "Instead of 'Signal', for 'Motion = displacement' [m]");
  }

  IncidentWaveParameters
  IncidentWaveParameters::read(const ParameterSection &section,
                               const std::string &name)
  {
    using Type = IncidentWaveType;
    IncidentWaveParameters wave;
    wave.name       = name;
    wave.type       = section.choice<Type>("Type",
                                     { { "plane P", Type::plane_p },
                                             { "plane SV", Type::plane_sv },
                                             { "Rayleigh", Type::rayleigh },
                                             { "line source", Type::line_source } });
    wave.half_plane = section.text("Space") == "half-plane";
    if (wave.type == Type::rayleigh)
    {
      if (!wave.half_plane)
        section.fail("Space", "has no surface for a Rayleigh wave: it needs "
                              "'half-plane'.");
      wave.angle = section.number("Angle");
      if (std::abs(wave.angle) != 90.)
        section.fail("Angle", "must be 90 or -90 for a Rayleigh wave, which "
                              "travels along the surface to +x or -x.");
    }
    else
    {
      const double limit = wave.half_plane ? 89. : 360.;
      wave.angle         = section.within("Angle", -limit, limit);
    }
    wave.angle *= degree;
    wave.n_integrations = section.choice<unsigned int>(
        "Motion",
        { { "displacement", 0 }, { "velocity", 1 }, { "acceleration", 2 } });
    const bool has_signal = !section.text("Signal").empty();
    wave.signal_entry     = has_signal ? "Signal" : "Displacement";
    if (has_signal && section.text("Displacement") != "0")
      section.fail("Displacement", "is given beside 'Signal': give one of "
                                   "them.");
    if (!has_signal && wave.n_integrations > 0)
      section.fail("Motion", "is for 'Signal': give that, and no "
                             "'Displacement'.");
    if (wave.type == Type::line_source)
    {
      wave.position = section.numbers<2>("Position");
      if (wave.half_plane)
        section.fail("Space", "is not for a line source, whose field is that "
                              "of the full plane: leave it at 'full plane' and "
                              "make the free surface a boundary.");
      if (!has_signal)
        section.fail("Signal", "must give the moment of the line source, by a "
                               "factor 'Amplitude'.");
      if (wave.n_integrations > 0)
        section.fail("Motion", "is not for a line source: its 'Signal' is the "
                               "moment. Leave it at 'displacement'.");
    }
    wave.amplitude = section.number("Amplitude");
    try
    {
      wave.signal
          = TimeFunction(section.text(wave.signal_entry), section.folder())
                .signal();
    }
    catch (const InputError &error)
    {
      section.fail(wave.signal_entry, error.what());
    }
    return wave;
  }

  std::function<double(double)>
  IncidentWaveParameters::function(const double begin, const double end,
                                   const double step) const
  {
    return [f      = integrated(signal, n_integrations, begin, end, step),
            factor = amplitude](const double t) { return factor * f(t); };
  }

  void SampledFieldParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Box", "", Anything(),
                      "xmin, ymin, xmax, ymax of the rectangle in which the "
                      "field is computed, at the end of the run, for "
                      "field.pvd; empty: nowhere [m]");
    prm.declare_entry("Spacing", "0", Double(), "Of its points [m]");
  }

  SampledFieldParameters
  SampledFieldParameters::read(const ParameterSection &section)
  {
    SampledFieldParameters field;
    field.has_box = !section.text("Box").empty();
    if (!field.has_box)
      return field;
    field.box = section.numbers<4>("Box");
    if (!(field.box[0] < field.box[2] && field.box[1] < field.box[3]))
      section.fail("Box", "must be xmin, ymin, xmax, ymax with xmin < xmax and "
                          "ymin < ymax.");
    field.spacing = section.positive("Spacing");
    const double n_points
        = (1. + (field.box[2] - field.box[0]) / field.spacing)
          * (1. + (field.box[3] - field.box[1]) / field.spacing);
    if (n_points > 1e6)
    {
      std::ostringstream why;
      why << "makes " << n_points
          << " points, more than a million: give a larger one.";
      section.fail("Spacing", why.str());
    }
    return field;
  }

  void BoundaryElementParameters::declare(dealii::ParameterHandler &prm)
  {
    prm.declare_entry("Material", "", Anything(),
                      "Of the domain; empty: the only one there is. What "
                      "lies beyond blocks of a Mohr-Coulomb material has its "
                      "elasticity and does not yield.");
    prm.declare_entry(
        "Formulation", "Galerkin",
        Selection("Galerkin|collocation|convolution quadrature"),
        "Of the integral equation: in the mean over each element or at its "
        "middle, with tractions and velocities constant in each time step; or "
        "in the mean by convolution quadrature.");
    prm.declare_entry("Analysis", "dynamic", Selection("dynamic|static"),
                      "Static: one solution, with the given values at t = "
                      "'Duration'.");
    prm.declare_entry("Element length", "0", Double(),
                      "Of boundaries that have none of their own [m]");
    prm.declare_entry("Highest frequency", "0", Double(),
                      "Of the waves that are to leave or come in: makes the "
                      "'Element length' a tenth of the length of the S wave of "
                      "this frequency; 0: the length is given [Hz]");
    prm.declare_entry("Step ratio", "0", Double(),
                      "c_1 times time step by length of the shortest element; "
                      "used if 'Time step' is 0. 0: 1, more if Poisson's ratio "
                      "is above 0.25 (c_2 times time step then is 0.58 "
                      "lengths), at most 1.5; with convolution quadrature 0.5 "
                      "[-]");
    prm.declare_entry("Time step", "0", Double(),
                      "0: as the ratio says. It is shortened until the run "
                      "ends at a step [s]");
    prm.declare_entry("Duration", "0", Double(), "Of the run [s]");
    prm.declare_entry("Coupling", "implicit", Selection("implicit|staggered"),
                      "With blocks. Implicit: the newest impedance acts on "
                      "each block step, on the nodes of the interface "
                      "implicitly; keeps the critical step. Staggered: by "
                      "extrapolated displacements, as Jin, Wang & Zhang do; "
                      "often unstable.");
    prm.declare_entry("Decay", "0", Double(),
                      "Rate of the decay of both kernels of Galerkin and "
                      "collocation [1/s]");
    prm.declare_entry("Mass damping", "0", Double(),
                      "Rayleigh damping, convolution quadrature only [1/s]");
    prm.declare_entry("Stiffness damping", "0", Double(),
                      "Rayleigh damping, convolution quadrature only [s]");
    prm.declare_entry("History", "compressed", Selection("compressed|direct"),
                      "How past steps are summed: at bounded cost, or as they "
                      "are written, at growing cost.");
    prm.declare_entry("Tolerance", "1e-6", Double(),
                      "Of the compressed history [-]");
    prm.declare_entry("Passivity frequencies", "64", Integer(0, 100000),
                      "Number of frequencies at which is looked, before the "
                      "run, whether the boundary can create energy; 0: not "
                      "at all.");
  }

  BoundaryElementParameters
  BoundaryElementParameters::read(const ParameterSection &section,
                                  const bool coupled)
  {
    BoundaryElementParameters parameters;
    parameters.material    = section.text("Material");
    parameters.formulation = section.choice<Formulation>(
        "Formulation",
        { { "Galerkin", Formulation::galerkin },
          { "collocation", Formulation::collocation },
          { "convolution quadrature", Formulation::convolution_quadrature } });
    const bool quadrature
        = parameters.formulation == Formulation::convolution_quadrature;
    parameters.is_static         = section.text("Analysis") == "static";
    parameters.element_length    = section.nonnegative("Element length");
    parameters.highest_frequency = section.nonnegative("Highest frequency");
    if (parameters.highest_frequency > 0. && parameters.element_length > 0.)
      section.fail("Highest frequency", "gives the elements' length, as "
                                        "'Element length' does: leave one of "
                                        "them at 0.");
    parameters.step_ratio = section.nonnegative("Step ratio");
    parameters.time_step  = section.nonnegative("Time step");
    parameters.duration   = parameters.is_static || coupled
                                ? section.nonnegative("Duration")
                                : section.positive("Duration");
    parameters.coupling   = section.choice<CouplingScheme>(
        "Coupling", { { "implicit", CouplingScheme::implicit },
                        { "staggered", CouplingScheme::staggered } });
    if (!coupled && parameters.coupling != CouplingScheme::implicit)
      section.fail("Coupling", "has no meaning without blocks: remove it.");
    if (parameters.is_static && section.number("Decay") > 0.)
      section.fail("Decay", "has no meaning with 'Analysis = static': remove "
                            "it.");
    if (coupled && parameters.is_static)
      section.fail("Analysis", "is that of a domain without blocks: leave it "
                               "at 'dynamic'.");
    if (coupled && parameters.duration > 0.)
      section.fail("Duration", "has no meaning here: the stages say how long "
                               "the run takes. Remove it.");
    parameters.decay = section.nonnegative("Decay");
    if (quadrature && parameters.decay > 0.)
      section.fail("Decay", "is not for convolution quadrature: use 'Mass "
                            "damping' and 'Stiffness damping'.");
    parameters.damping.mass      = section.nonnegative("Mass damping");
    parameters.damping.stiffness = section.nonnegative("Stiffness damping");
    for (const std::string name : { "Mass damping", "Stiffness damping" })
      if (!quadrature && section.number(name) > 0.)
        section.fail(name, "needs 'Formulation = convolution quadrature'; "
                           "other formulations take 'Decay'.");
    if (parameters.is_static && quadrature)
      section.fail("Formulation", "has no statics: use Galerkin or "
                                  "collocation.");
    parameters.direct_history = section.text("History") == "direct";
    parameters.tolerance      = section.within("Tolerance", 1e-12, 1e-2);
    parameters.n_frequencies  = section.integer("Passivity frequencies");
    return parameters;
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
