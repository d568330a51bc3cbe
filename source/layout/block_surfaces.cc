// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/base/number_text.h>
#include <quoin/layout/block_surfaces.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "closed_surfaces.h"

namespace quoin
{
  namespace
  {
    using SpacePoint = dealii::Point<3>;

    /** A text file of a kind of lines for each first word. */
    class LineReader
    {
    public:
      explicit LineReader(const std::string &file) : file(file), stream(file)
      {
      }

      /** Reads the next line that is not empty. Commas are spaces. */
      bool next()
      {
        for (std::string line; std::getline(stream, line);)
        {
          ++number;
          std::replace(line.begin(), line.end(), ',', ' ');
          words = std::istringstream(line);
          if (words >> key)
            return true;
        }
        return false;
      }

      [[noreturn]] void fail(const std::string &what) const
      {
        throw InputError("Mesh '" + file + "', line " + std::to_string(number)
                         + ": " + what);
      }

      template <typename Number>
      Number get(const std::string &what)
      {
        Number value;
        if (!(words >> value))
          fail(what + " is missing or no number.");
        return value;
      }

      SpacePoint point()
      {
        SpacePoint p;
        for (unsigned int d = 0; d < 3; ++d)
          p[d] = get<double>("a coordinate");
        return p;
      }

      /** The rest of the line without spaces at its ends. */
      std::string rest()
      {
        std::string text, word;
        while (words >> word)
          text += (text.empty() ? "" : " ") + word;
        return text;
      }

      std::string key; /**< first word of the line */
      std::istringstream words;

    private:
      const std::string file;
      std::ifstream stream;
      unsigned int number = 0;
    };

    FacetSoup read_obj(const std::string &file)
    {
      LineReader line(file);
      FacetSoup soup;
      std::string material = "block", object;
      while (line.next())
        if (line.key == "v")
          soup.points.push_back(line.point());
        else if (line.key == "f")
        {
          Facet facet{ {}, object, material };
          for (std::string word; line.words >> word;)
          {
            const int number = std::atoi(word.c_str()); // of 3/1/2, 3//2 or 3
            const int place
                = number > 0 ? number - 1 : int(soup.points.size()) + number;
            if (number == 0 || place < 0 || place >= int(soup.points.size()))
              line.fail("vertex '" + word + "' is not there: "
                        + std::to_string(soup.points.size())
                        + " vertices stand before this line.");
            facet.corners.push_back(place);
          }
          if (facet.corners.size() < 3)
            line.fail("a face needs three vertices.");
          soup.facets.push_back(facet);
        }
        else if (line.key == "o" || line.key == "g")
          object = line.rest();
        else if (line.key == "usemtl")
          material = line.rest();
        else if (line.key[0] != '#')
          ++soup.n_ignored;
      return soup;
    }

    FacetSoup read_text_stl(const std::string &file)
    {
      LineReader line(file);
      FacetSoup soup;
      std::string solid;
      unsigned int n_corners = 0;
      while (line.next())
        if (line.key == "solid")
          solid = line.rest() + ' ' + std::to_string(soup.facets.size());
        else if (line.key == "vertex")
        {
          if (n_corners == 0)
            soup.facets.push_back({ {}, solid, "block" });
          if (++n_corners > 3)
            line.fail("a facet has more than three vertices.");
          soup.facets.back().corners.push_back(soup.points.size());
          soup.points.push_back(line.point());
        }
        else if (line.key == "endloop")
        {
          if (n_corners != 3)
            line.fail("a facet has less than three vertices.");
          n_corners = 0;
        }
      return soup;
    }

    FacetSoup read_binary_stl(const std::string &file)
    {
      // 80 bytes, the number of facets, and for each the normal, three
      // vertices and two bytes.
      constexpr std::size_t header = 84, record = 50;
      std::ifstream stream(file, std::ios::binary);
      std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
      std::uint32_t n = 0;
      if (bytes.size() >= header)
        std::memcpy(&n, bytes.data() + 80, sizeof(n));
      if (bytes.size() < header || bytes.size() - header != record * n)
        throw InputError("Mesh '" + file
                         + "': this is no STL file: neither text, which begins "
                           "with 'solid', nor binary, whose size goes with the "
                           "number of its facets.");
      FacetSoup soup;
      for (std::uint32_t f = 0; f < n; ++f)
      {
        float x[9];
        std::memcpy(x, bytes.data() + header + record * f + 12, sizeof(x));
        const unsigned int first = soup.points.size();
        for (unsigned int k = 0; k < 3; ++k)
          soup.points.emplace_back(x[3 * k], x[3 * k + 1], x[3 * k + 2]);
        soup.facets.push_back({ { first, first + 1, first + 2 }, "", "block" });
      }
      return soup;
    }

    FacetSoup read_stl(const std::string &file)
    {
      // A binary file may begin with 'solid', too, but has no such line.
      std::ifstream stream(file, std::ios::binary);
      std::string begin(512, ' ');
      stream.read(begin.data(), begin.size());
      return begin.compare(0, 5, "solid") == 0
                     && begin.find("facet") != std::string::npos
                 ? read_text_stl(file)
                 : read_binary_stl(file);
    }

    using Numbers = std::vector<int>;

    /** Numbers to the end of the line. */
    Numbers numbers(LineReader &line)
    {
      Numbers result;
      for (int number; line.words >> number;)
        result.push_back(number);
      if (!line.words.eof())
        line.fail("there is a word that is no integer.");
      return result;
    }

    /** The facets of tetrahedra that only one of them has. */
    std::vector<Numbers> surface_of(const std::vector<Numbers> &zones)
    {
      std::map<Numbers, Numbers> once; // by sorted corners
      for (const Numbers &zone : zones)
        for (unsigned int k = 0; k < 4; ++k)
        {
          Numbers facet = zone;
          facet.erase(facet.begin() + k);
          Numbers key = facet;
          std::sort(key.begin(), key.end());
          if (!once.try_emplace(key, facet).second)
            once.erase(key);
        }
      std::vector<Numbers> facets;
      for (const auto &[key, facet] : once)
        facets.push_back(facet);
      return facets;
    }

    FacetSoup read_3dec_grid(const std::string &file)
    {
      LineReader line(file);
      FacetSoup soup;
      std::map<int, unsigned int> places; // of points, by their numbers
      std::map<int, Numbers> faces, zones;
      const auto corners = [&](const std::size_t least, const std::size_t most)
      {
        Numbers result = numbers(line);
        if (result.size() < least || result.size() > most)
          line.fail("a " + std::string(line.key == "F" ? "face" : "zone")
                    + " needs " + std::to_string(least)
                    + (most > least ? " gridpoints or more." : " gridpoints."));
        for (const int p : result)
          if (places.count(p) == 0)
            line.fail("gridpoint " + std::to_string(p)
                      + " has no G line before this one.");
        return result;
      };
      while (line.next())
        if (line.key == "G")
        {
          places[line.get<int>("the number of the gridpoint")]
              = soup.points.size();
          soup.points.push_back(line.point());
        }
        else if (line.key == "F")
        {
          const int number = line.get<int>("the number of the face");
          faces[number]    = corners(3, 1000);
        }
        else if (line.key == "Z")
        {
          const int number = line.get<int>("the number of the zone");
          zones[number]    = corners(4, 4);
        }
        else if (line.key == "B")
        {
          const int block  = line.get<int>("the number of the block");
          const int region = line.get<int>("the number of the region");
          const auto kind  = line.get<std::string>("'F' or 'Z'");
          if (kind != "F" && kind != "Z")
            line.fail("'F' and faces or 'Z' and zones must follow, not '" + kind
                      + "'.");
          std::vector<Numbers> parts;
          const auto &all = kind == "F" ? faces : zones;
          for (const int part : numbers(line))
          {
            const auto found = all.find(part);
            if (found == all.end())
              line.fail((kind == "F" ? "face " : "zone ") + std::to_string(part)
                        + " has no line before this one.");
            parts.push_back(found->second);
          }
          for (const Numbers &facet : kind == "F" ? parts : surface_of(parts))
          {
            soup.facets.push_back({ {},
                                    std::to_string(block),
                                    "region " + std::to_string(region) });
            for (const int p : facet)
              soup.facets.back().corners.push_back(places.at(p));
          }
        }
        else if (line.key[0] != '*' && line.key != "TOL")
          ++soup.n_ignored;
      return soup;
    }

    std::string ending(const std::string &file)
    {
      std::string result = std::filesystem::path(file).extension();
      std::transform(result.begin(), result.end(), result.begin(), ::tolower);
      return result;
    }

    /** Lower and upper corner of a box around @p points. */
    std::pair<SpacePoint, SpacePoint>
    box_of(const std::vector<SpacePoint> &points)
    {
      std::pair<SpacePoint, SpacePoint> box(points.front(), points.front());
      for (const SpacePoint &p : points)
        for (unsigned int d = 0; d < 3; ++d)
        {
          box.first[d]  = std::min(box.first[d], p[d]);
          box.second[d] = std::max(box.second[d], p[d]);
        }
      return box;
    }

    /** The command for the surfaces at a side of the box around the blocks. */
    void write_side(const std::pair<SpacePoint, SpacePoint> &box,
                    const unsigned int side, const double tolerance,
                    std::ostream &text)
    {
      auto [low, high] = box;
      (side % 2 == 0 ? high : low)[side / 2]
          = (side % 2 == 0 ? low : high)[side / 2];
      text << "side() = Surface In BoundingBox {";
      for (unsigned int d = 0; d < 3; ++d)
        text << low[d] - tolerance << ", ";
      for (unsigned int d = 0; d < 3; ++d)
        text << high[d] + tolerance << (d < 2 ? ", " : "};\n");
      text << "If (#side() > 0)\n  Physical Surface(\"" << block_sides[side]
           << "\") = side();\nEndIf\n";
    }

    /** Text of a geometry. Commands that make surfaces and volumes number
        loops of their own: so all curve loops come first. */
    class GeometryText
    {
    public:
      GeometryText()
      {
        for (std::ostringstream *text : { &curves, &surfaces, &volumes })
          text->precision(17);
      }

      void add(const BlockSurfaces::Block &block)
      {
        GmshNumbers shell;
        for (const BlockSurfaces::Face &face : block.faces)
        {
          GmshNumbers loops;
          for (const BlockSurfaces::Loop &loop : face.loops)
            loops.push_back(add_loop(loop));
          shell.push_back(++n_surfaces);
          surfaces << "Plane Surface(" << n_surfaces << ") = " << braces(loops)
                   << ";\n";
        }
        ++n_volumes;
        volumes << "Surface Loop(" << n_volumes << ") = " << braces(shell)
                << ";\nVolume(" << n_volumes << ") = {" << n_volumes << "};\n";
      }

      std::string text() const
      {
        return curves.str() + surfaces.str() + volumes.str();
      }

    private:
      int add_loop(const BlockSurfaces::Loop &loop)
      {
        GmshNumbers numbers;
        for (std::size_t i = 0; i < loop.size(); ++i)
        {
          const unsigned int from = loop[i], to = loop[(i + 1) % loop.size()];
          const auto [line, is_new]
              = lines.try_emplace(std::minmax(from, to), lines.size() + 1);
          if (is_new)
            curves << "Line(" << line->second << ") = {"
                   << std::min(from, to) + 1 << ", " << std::max(from, to) + 1
                   << "};\n";
          numbers.push_back(from < to ? line->second : -line->second);
        }
        curves << "Curve Loop(" << ++n_loops << ") = " << braces(numbers)
               << ";\n";
        return n_loops;
      }

      std::ostringstream curves, surfaces, volumes;
      std::map<std::pair<unsigned int, unsigned int>, int> lines;
      int n_loops = 0, n_surfaces = 0, n_volumes = 0;
    };
  } // namespace

  bool is_surface_file(const std::string &file)
  {
    const std::string end = ending(file);
    return end == ".obj" || end == ".stl" || end == ".3dgrid";
  }

  BlockSurfaces read_block_surfaces(const std::string &file)
  {
    const std::string end = ending(file);
    FacetSoup soup        = end == ".obj"   ? read_obj(file)
                            : end == ".stl" ? read_stl(file)
                                            : read_3dec_grid(file);
    for (const SpacePoint &p : soup.points)
      if (!std::isfinite(p.norm()))
        throw InputError("Mesh '" + file
                         + "': a coordinate is no finite number.");
    return closed_surfaces(soup, file);
  }

  GmshGeometry block_geometry(const BlockSurfaces &blocks,
                              const double element_size)
  {
    std::ostringstream text;
    text.precision(17);
    const auto box         = box_of(blocks.points);
    const double tolerance = 1e-6 * box.first.distance(box.second);
    // OpenCASCADE enlarges the boxes of surfaces by 1e-7.
    const double at_side = std::max(tolerance, 1e-6);
    text << "// Blocks; joints have no thickness.\n"
            "SetFactory(\"OpenCASCADE\");\n"
            "DefineConstant[ size = {"
         << element_size << ", Name \"Element size\"} ];\n";
    for (unsigned int v = 0; v < blocks.points.size(); ++v)
    {
      const SpacePoint &p = blocks.points[v];
      text << "Point(" << v + 1 << ") = {" << p[0] << ", " << p[1] << ", "
           << p[2] << ", size};\n";
    }
    GeometryText made;
    std::map<std::string, GmshNumbers> groups;
    for (unsigned int b = 0; b < blocks.blocks.size(); ++b)
    {
      made.add(blocks.blocks[b]);
      groups[blocks.blocks[b].group].push_back(b + 1);
    }
    text << made.text();
    // Faces that touch are cut along the outlines of both; of a single block
    // there is nothing to cut, which gmsh takes for an error.
    text << "Geometry.ToleranceBoolean = " << tolerance << ";\n"
         << (blocks.blocks.size() > 1 ? "Coherence;\n" : "")
         << "other() = Volume{:};\nn = #other();\nother() -= {1 "
            ": "
         << blocks.blocks.size() << "};\nIf (n != " << blocks.blocks.size()
         << " || #other() > 0)\n"
            "  Error(\"blocks overlap, or one is hollow\");\nEndIf\n"
            // Faces with holes are left over beside those of their volumes.
            "joint() = Unique(Abs(Boundary{ Volume{:}; }));\n"
            "left_over() = Surface{:};\nleft_over() -= joint();\n"
            "If (#left_over() > 0)\n  Delete { Surface{left_over()}; }\n"
            "EndIf\n"
            "joint() -= Abs(CombinedBoundary{ Volume{:}; });\n"
            "If (#joint() > 0)\n  Physical Surface(\"joint\") = joint();\n"
            "EndIf\n";
    for (const auto &[group, volumes] : groups)
      text << "Physical Volume(\"" << group << "\") = " << braces(volumes)
           << ";\n";
    for (unsigned int side = 0; side < 6; ++side)
      write_side(box, side, at_side, text);
    text << "Mesh.MeshSizeMax = size;\n";
    GmshGeometry geometry;
    geometry.text = text.str();
    if (blocks.blocks.size() > 1)
      geometry.joint_curves = { "joint" };
    return geometry;
  }

  std::string block_report(const BlockSurfaces &blocks)
  {
    double least = blocks.blocks[0].volume, most = 0., total = 0.;
    for (const BlockSurfaces::Block &block : blocks.blocks)
    {
      least = std::min(least, block.volume);
      most  = std::max(most, block.volume);
      total += block.volume;
    }
    std::string text = std::to_string(blocks.blocks.size())
                       + " blocks, volumes from " + number_text(least) + " to "
                       + number_text(most) + " m^3, in all "
                       + number_text(total) + " m^3";
    if (blocks.n_ignored > 0)
      text += "\n" + std::to_string(blocks.n_ignored)
              + " lines of the file are of kinds that are not read";
    return text;
  }
} // namespace quoin
