// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include "../base/message_of.h"
#include "../output/temporary_directory.h"

#include <quoin/farfield/boundary_values.h>
#include <quoin/parameters/parameters.h>
#include <quoin/base/exceptions.h>

#include <cmath>

using namespace quoin;

namespace
{
  const std::string good = R"(
set Model = boundary elements
subsection Materials
  set Names = rock
  subsection rock
    set Density = 2500
    set Young's modulus = 18.75e9
    set Poisson's ratio = 0.25
  end
end
subsection Boundary elements
  set Formulation = convolution quadrature
  set Step ratio = 0.8
  set Duration = 0.25
  set Mass damping = 3
  set Stiffness damping = 1e-4
  set History = direct
  set Element length = 0.5
  set Names = hole, surface
  subsection hole
    set Centre = 1, -2
    set Radius = 0.5
    set Elements = 12
    set Area = equal
    set Pressure = 1e6 * sin(t)
  end
  subsection surface
    set Shape = line
    set Points = 9, 0; 1, 0
    set Domain = left
    set Grading = 0.25
    set Horizontal = displacement table ramp.csv times x - 1
    set Vertical = traction 2 * x + y
  end
end
subsection Incident waves
  set Names = sv
  subsection sv
    set Type = plane SV
    set Space = half-plane
    set Angle = 30
    set Displacement = 1e-3 * t
  end
end
subsection Histories
  set Names = force
  subsection force
    set Quantity = boundary moment
    set Curve = hole
  end
end
)";

  struct Case
  {
    TemporaryDirectory directory;
    std::string file;

    explicit Case(const std::string &text) : file(directory / "case.prm")
    {
      std::ofstream(file) << text;
      std::ofstream(directory / "ramp.csv") << "time,value\n0,0\n1,10\n";
    }

    Parameters read(const std::vector<std::string> &overrides = {}) const
    {
      return read_parameters(file, overrides);
    }
  };
} // namespace

TEST(BoundaryParameters, All)
{
  const Parameters parameters = Case(good).read();
  EXPECT_TRUE(parameters.is_boundary_model);
  const BoundaryElementParameters &boundary = parameters.boundary;
  EXPECT_EQ(boundary.formulation, Formulation::convolution_quadrature);
  EXPECT_EQ(boundary.material, "rock");
  EXPECT_EQ(boundary.step_ratio, 0.8);
  EXPECT_EQ(boundary.duration, 0.25);
  EXPECT_EQ(boundary.damping.mass, 3.);
  EXPECT_EQ(boundary.damping.stiffness, 1e-4);
  EXPECT_TRUE(boundary.direct_history);
  EXPECT_FALSE(boundary.is_static);
  EXPECT_FALSE(boundary.sampled_field.has_box);

  ASSERT_EQ(boundary.boundaries.size(), 2u);
  const BoundaryCurveParameters &hole = boundary.boundaries[0];
  EXPECT_EQ(hole.shape, BoundaryShape::circle);
  EXPECT_EQ(hole.domain, DomainSide::outside);
  EXPECT_EQ(hole.polygon, CirclePolygon::equal_area);
  EXPECT_EQ(hole.centre[1], -2.);
  EXPECT_TRUE(hole.traction_is_given[0]);
  EXPECT_NEAR(hole.pressure(dealii::Point<2>(5., 6.), 0.5), 1e6 * std::sin(0.5),
              1e-9);
  EXPECT_FALSE(hole.pressure.depends_on_place());
  EXPECT_TRUE(hole.pressure.depends_on_time());
  EXPECT_FALSE(hole.value[0].depends_on_time());

  const BoundaryCurveParameters &surface = boundary.boundaries[1];
  EXPECT_EQ(surface.shape, BoundaryShape::line);
  EXPECT_EQ(surface.points[0][0], 9.);
  EXPECT_FALSE(surface.traction_is_given[0]);
  EXPECT_TRUE(surface.traction_is_given[1]);
  EXPECT_NEAR(surface.value[0](dealii::Point<2>(3., 0.), 0.5), 10., 1e-12);
  EXPECT_TRUE(surface.value[0].depends_on_place());
  EXPECT_TRUE(surface.value[0].depends_on_time());
  EXPECT_FALSE(surface.value[1].depends_on_time());

  ASSERT_EQ(boundary.waves.size(), 1u);
  EXPECT_EQ(boundary.waves[0].type, IncidentWaveType::plane_sv);
  EXPECT_TRUE(boundary.waves[0].half_plane);
  EXPECT_NEAR(boundary.waves[0].angle, M_PI / 6., 1e-15);
}

TEST(BoundaryParameters, BoundaryValues)
{
  Case files(good);
  const Parameters parameters
      = files.read({ "Boundary elements/Formulation=Galerkin",
                     "Boundary elements/Mass damping=0",
                     "Boundary elements/Stiffness damping=0",
                     "Boundary elements/hole/Pressure=if(t > 0, 2, 0)",
                     "Boundary elements/hole/Horizontal=traction x^2 * t" });
  const BoundaryGeometry geometry = make_boundary_geometry(parameters.boundary);
  BoundaryValues given(geometry, parameters.boundary);
  given.check_start();
  const Eigen::VectorXd first  = given(0., 0.1);
  const Eigen::VectorXd second = given(0.1, 0.3);
  const Eigen::VectorXd end    = given.at(0.3);
  for (unsigned int e = 0; e < geometry.owner.size(); ++e)
  {
    const BoundaryElement &element = geometry.boundary.elements[e];
    const double x = element.middle()[0], y = element.middle()[1];
    if (geometry.owner[e] == 0)
    {
      EXPECT_TRUE(given.traction_is_given()[2 * e]);
      // What is switched on at t = 0 counts in full.
      EXPECT_NEAR(first[2 * e + 1], -2. * element.normal()[1], 1e-14);
      const double mean_square
          = x * x + std::pow(element.b[0] - element.a[0], 2) / 12.;
      const double pressure = -2. * element.normal()[0];
      EXPECT_NEAR(second[2 * e], mean_square * 0.2 + pressure, 1e-13);
      EXPECT_NEAR(end[2 * e], mean_square * 0.3 + pressure, 1e-13);
    }
    else
    {
      EXPECT_FALSE(given.traction_is_given()[2 * e]);
      EXPECT_NEAR(second[2 * e], 3. * (x - 1.), 1e-12);
      EXPECT_NEAR(second[2 * e + 1], 2. * x + y, 1e-13);
    }
  }
}

TEST(BoundaryParameters, MotionBeginsAtZero)
{
  Case files(good);
  const Parameters parameters
      = files.read({ "Boundary elements/surface/Horizontal=displacement x" });
  const BoundaryGeometry geometry = make_boundary_geometry(parameters.boundary);
  EXPECT_THROW(BoundaryValues(geometry, parameters.boundary).check_start(),
               InputError);
}

TEST(BoundaryParameters, BlocksAreUntouched)
{
  Case files(good);
  const auto refused = [&](const std::string &setting)
  { return message_of<InputError>([&] { files.read({ setting }); }); };
  EXPECT_NE(refused("Model=blocks").find("section 'Mesh': 'File"),
            std::string::npos);
  EXPECT_NE(
      refused("Stages/Names=first").find("'Names = first' has no meaning"),
      std::string::npos);
  EXPECT_NE(refused("Plane assumption=plane stress").find("plane strain"),
            std::string::npos);
}

TEST(BoundaryParameters, IncidentWaves)
{
  const Case files(good);
  const auto read = [&](std::vector<std::string> settings)
  {
    for (std::string &setting : settings)
      setting = "Incident waves/sv/" + setting;
    return files.read(settings).boundary.waves.at(0);
  };
  const auto refused = [&](const std::vector<std::string> &settings)
  { return message_of<InputError>([&] { read(settings); }); };

  const IncidentWaveParameters plain = read({ "Amplitude=2" });
  EXPECT_NEAR(plain.function(0., 1., 0.01)(0.5), 1e-3, 1e-15);

  // From acceleration to displacement, in closed form and not.
  for (const std::string signal :
       { "wavelet Ricker 5 0.4", "wavelet Ricker 5 0.4 times 1" })
  {
    const IncidentWaveParameters wave
        = read({ "Displacement=0", "Signal=" + signal, "Motion=acceleration",
                 "Amplitude=3" });
    const double a = M_PI * 5.;
    EXPECT_NEAR(wave.function(0., 2., 1e-3)(0.4), -1.5 / (a * a), 1e-7);
  }

  const IncidentWaveParameters rayleigh
      = read({ "Type=Rayleigh", "Angle=-90" });
  EXPECT_EQ(rayleigh.type, IncidentWaveType::rayleigh);
  EXPECT_LT(rayleigh.angle, 0.);

  const IncidentWaveParameters source
      = read({ "Type=line source", "Space=full plane", "Position=3, -4",
               "Displacement=0", "Signal=pulse exponential 1e-3 1e-2",
               "Amplitude=1e8" });
  EXPECT_EQ(source.position[1], -4.);
  EXPECT_NEAR(source.function(0., 1., 0.1)(1e-3), 1e8, 1e-4);

  EXPECT_NE(refused({ "Type=Rayleigh" }).find("90 or -90"), std::string::npos);
  EXPECT_NE(refused({ "Type=line source" }).find("full plane"),
            std::string::npos);
  EXPECT_NE(refused({ "Signal=t" }).find("one of them"), std::string::npos);
  EXPECT_NE(refused({ "Motion=velocity" }).find("'Signal'"), std::string::npos);
}

TEST(BoundaryParameters, RecordsOfAnotherMotion)
{
  const Case files(good);
  std::ofstream(files.directory / "quake.AT2")
      << "NPTS= 3, DT= .01 SEC\n0 0.1 0\n";
  const auto refusal = [&](const std::vector<std::string> &settings)
  { return message_of<InputError>([&] { files.read(settings); }); };
  const std::string wave   = "Incident waves/sv/";
  const std::string record = wave + "Signal=record quake.AT2";
  const std::string none   = "nothing was thrown";

  const std::string why = refusal({ wave + "Displacement=0", record });
  EXPECT_NE(why.find("must be of displacement"), std::string::npos) << why;
  EXPECT_NE(why.find("'Motion = acceleration'"), std::string::npos) << why;
  EXPECT_EQ(refusal({ wave + "Displacement=0", record,
                      wave + "Motion=acceleration" }),
            none);
  EXPECT_EQ(refusal({ wave + "Displacement=0", record + " integrated once",
                      wave + "Motion=velocity" }),
            none);
  EXPECT_NE(refusal({ wave + "Displacement=record quake.AT2" })
                .find("'Signal' with 'Motion = acceleration'"),
            std::string::npos);

  const std::string surface = "Boundary elements/surface/Horizontal=";
  EXPECT_NE(refusal({ surface + "displacement record quake.AT2" })
                .find("'integrated twice'"),
            std::string::npos);
  EXPECT_EQ(
      refusal({ surface + "displacement record quake.AT2 integrated twice" }),
      none);
  EXPECT_EQ(refusal({ surface + "traction record quake.AT2" }), none);
}
