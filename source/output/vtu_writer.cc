// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/atomic_file.h>
#include <quoin/output/vtu_writer.h>

#include <stdexcept>

namespace quoin
{
  namespace
  {
    static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__,
                  "The VTU files say that they are little endian.");

    struct Block
    {
      const char *data;
      std::uint64_t size;
    };

    template <typename T>
    const char *vtk_type()
    {
      if constexpr (std::is_same_v<T, double>)
        return "Float64";
      else if constexpr (std::is_same_v<T, std::int32_t>)
        return "Int32";
      else
        return "UInt8";
    }

    /** The XML header and the blocks of data that its offsets point at. */
    class Document
    {
    public:
      std::string xml;

      template <typename T>
      void add_array(const std::string &name, const unsigned int n_components,
                     const std::vector<T> &values,
                     const std::vector<std::string> &component_names = {},
                     const std::string &more                         = "")
      {
        xml += "<DataArray type=\"" + std::string(vtk_type<T>()) + "\" Name=\""
               + name + "\"" + more + " NumberOfComponents=\""
               + std::to_string(n_components) + "\"";
        for (unsigned int c = 0; c < component_names.size(); ++c)
          xml += " ComponentName" + std::to_string(c) + "=\""
                 + component_names[c] + "\"";
        xml += " format=\"appended\" offset=\"" + std::to_string(offset)
               + "\"/>\n";
        const std::uint64_t size = values.size() * sizeof(T);
        blocks.push_back(
            { reinterpret_cast<const char *>(values.data()), size });
        offset += sizeof(std::uint64_t) + size;
      }

      void write(std::ostream &out) const
      {
        out << xml;
        for (const Block &block : blocks)
        {
          out.write(reinterpret_cast<const char *>(&block.size),
                    sizeof(block.size));
          out.write(block.data, block.size);
        }
        out << "\n</AppendedData>\n</VTKFile>\n";
      }

    private:
      std::vector<Block> blocks;
      std::uint64_t offset = 0;
    };

    template <typename T>
    std::vector<T> with_third_component(const std::vector<T> &plane)
    {
      std::vector<T> space(plane.size() / 2 * 3, T());
      for (std::size_t i = 0; i < plane.size() / 2; ++i)
      {
        space[3 * i]     = plane[2 * i];
        space[3 * i + 1] = plane[2 * i + 1];
      }
      return space;
    }

    /** Checks sizes and adds z = 0 to vectors in the plane. */
    void complete(std::vector<VtuField> &fields, const std::size_t n)
    {
      for (VtuField &field : fields)
        std::visit(
            [&](auto &values)
            {
              if (values.size() != n * field.n_components)
                throw std::logic_error("The VTU field '" + field.name
                                       + "' does not fit its grid.");
              if (field.n_components == 2)
              {
                values             = with_third_component(values);
                field.n_components = 3;
              }
            },
            field.values);
    }

    void add_fields(Document &document, const std::string &tag,
                    const std::vector<VtuField> &fields)
    {
      document.xml += "<" + tag + ">\n";
      for (const VtuField &field : fields)
        std::visit(
            [&](const auto &values)
            {
              document.add_array(field.name, field.n_components, values,
                                 field.component_names);
            },
            field.values);
      document.xml += "</" + tag + ">\n";
    }
  } // namespace

  void complete(VtuGrid &grid)
  {
    complete(grid.point_data, grid.points.size() / grid.dimension);
    complete(grid.cell_data, grid.n_cells());
    if (grid.dimension == 2)
      grid.points = with_third_component(grid.points);
    grid.dimension = 3;
  }

  void write_vtu(const std::string &path, VtuGrid grid)
  {
    complete(grid);
    const std::size_t n_cells   = grid.n_cells();
    const std::size_t n_nodes   = grid.points.size() / 3;
    const unsigned int per_cell = n_points(grid.cell_type);

    // The document refers to the grid and these arrays until it is written.
    const std::vector<double> time(1, grid.time);
    std::vector<std::int32_t> offsets(n_cells);
    for (std::size_t i = 0; i < n_cells; ++i)
      offsets[i] = static_cast<std::int32_t>(per_cell * (i + 1));
    const std::vector<std::uint8_t> types(
        n_cells, static_cast<std::uint8_t>(grid.cell_type));

    Document document;
    document.xml = "<?xml version=\"1.0\"?>\n"
                   "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
                   "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
                   "<UnstructuredGrid>\n<FieldData>\n";
    document.add_array("TimeValue", 1, time, {}, " NumberOfTuples=\"1\"");
    document.xml += "</FieldData>\n<Piece NumberOfPoints=\""
                    + std::to_string(n_nodes) + "\" NumberOfCells=\""
                    + std::to_string(n_cells) + "\">\n";
    add_fields(document, "PointData", grid.point_data);
    add_fields(document, "CellData", grid.cell_data);
    document.xml += "<Points>\n";
    document.add_array("Points", 3, grid.points);
    document.xml += "</Points>\n<Cells>\n";
    document.add_array("connectivity", 1, grid.cells);
    document.add_array("offsets", 1, offsets);
    document.add_array("types", 1, types);
    document.xml += "</Cells>\n</Piece>\n</UnstructuredGrid>\n"
                    "<AppendedData encoding=\"raw\">\n_";

    AtomicFile file(path);
    document.write(file.stream());
    file.commit();
  }
} // namespace quoin
