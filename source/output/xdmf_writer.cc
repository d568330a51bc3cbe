// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/exceptions.h>
#include <quoin/output/atomic_file.h>
#include <quoin/output/collective.h>
#include <quoin/output/csv_table.h>
#include <quoin/output/xdmf_writer.h>

#include <deal.II/base/mpi.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <functional>
#include <numeric>
#include <string_view>

namespace quoin
{
  namespace
  {
    namespace fs = std::filesystem;

    const std::string closing = "</Grid>\n</Domain>\n</Xdmf>\n";

    /** ParaView's second reader takes no offset beyond. */
    constexpr std::uint64_t largest_file = std::uint64_t(1) << 32;

    /** An element of a grid that has an array. */
    struct Element
    {
      std::string tag;  /**< XML tag with attributes */
      std::string type; /**< attributes of the array */
      std::string_view bytes;
      bool is_mesh       = false;
      std::uint64_t hash = 0;
    };

    template <typename T>
    Element element(const std::string &tag, const unsigned int n_components,
                    const std::vector<T> &values, const bool is_mesh = false)
    {
      std::string type
          = "Dimensions=\"" + std::to_string(values.size() / n_components);
      if (n_components > 1)
        type += " " + std::to_string(n_components);
      type += "\" NumberType=\"";
      type += std::is_same_v<T, double>         ? "Float"
              : std::is_same_v<T, std::int32_t> ? "Int"
                                                : "UChar";
      type += "\" Precision=\"" + std::to_string(sizeof(T)) + "\"";
      const std::string_view bytes(
          reinterpret_cast<const char *>(values.data()),
          values.size() * sizeof(T));
      return { tag, type, bytes, is_mesh,
               std::hash<std::string_view>()(bytes) };
    }

    void add_fields(const std::string &centre,
                    const std::vector<VtuField> &fields,
                    std::vector<Element> &elements)
    {
      for (const VtuField &field : fields)
      {
        // A tensor of six would become one of nine.
        const bool is_vector
            = field.n_components == 3 && field.component_names.empty();
        std::visit(
            [&](const auto &values)
            {
              elements.push_back(element(
                  "Attribute Name=\"" + field.name + "\" AttributeType=\""
                      + (field.n_components == 1 ? "Scalar"
                         : is_vector             ? "Vector"
                                                 : "Matrix")
                      + "\" Center=\"" + centre + "\"",
                  field.n_components, values));
            },
            field.values);
      }
    }

    /** XML elements of a complete grid, which refer to its arrays. */
    std::vector<Element> elements_of(const VtuGrid &grid)
    {
      std::vector<Element> elements;
      if (grid.cells.empty())
        return elements;
      const unsigned int per_cell = n_points(grid.cell_type);
      elements.push_back(element(
          std::string("Topology TopologyType=\"")
              + (grid.cell_type == VtuCellType::line
                     ? "Polyline\" NodesPerElement=\"2"
                 : grid.cell_type == VtuCellType::triangle ? "Triangle"
                                                           : "Tetrahedron")
              + "\" NumberOfElements=\"" + std::to_string(grid.n_cells())
              + "\"",
          per_cell, grid.cells, true));
      elements.push_back(
          element("Geometry GeometryType=\"XYZ\"", 3, grid.points, true));
      add_fields("Node", grid.point_data, elements);
      add_fields("Cell", grid.cell_data, elements);
      return elements;
    }

    /**
     * The path to a data file in the same folder, another one for each
     * @p offset of a mesh: "./" and ".//" are its binary digits. ParaView's
     * first reader keeps a mesh as long as the names of the files from which
     * its arrays come are the same, whatever their offsets.
     */
    std::string mesh_path(std::uint64_t offset)
    {
      std::string path;
      for (; offset > 0; offset /= 2)
        path += offset % 2 == 0 ? "./" : ".//";
      return path;
    }

    std::string xml_of(const Element &element, const std::uint64_t offset,
                       const std::string &file)
    {
      return "<" + element.tag + ">\n<DataItem " + element.type
             + " Format=\"Binary\" Endian=\"Little\" Seek=\""
             + std::to_string(offset) + "\">"
             + (element.is_mesh ? mesh_path(offset) : "") + file
             + "</DataItem>\n</" + element.tag.substr(0, element.tag.find(' '))
             + ">\n";
    }

    /** Collective: appends @p arrays of all ranks, of @p sizes bytes
        altogether, to @p file on the first one. */
    void append(const std::vector<std::string_view> &arrays,
                const std::vector<std::uint64_t> &sizes, const bool is_first,
                const MPI_Comm communicator, const std::string &file)
    {
      constexpr std::size_t largest_message = 1 << 28;
      constexpr int tag                     = 4711;
      if (!is_first)
        for (std::string_view rest : arrays)
          while (!rest.empty())
          {
            const std::size_t n = std::min(rest.size(), largest_message);
            MPI_Send(rest.data(), int(n), MPI_CHAR, 0, tag, communicator);
            rest.remove_prefix(n);
          }
      all_or_none<RunError>(
          communicator,
          [&]()
          {
            if (!is_first)
              return;
            FileBuffer buffer(file, true);
            for (const std::string_view array : arrays)
              buffer.sputn(array.data(), std::streamsize(array.size()));
            std::vector<char> message;
            for (unsigned int rank = 1; rank < sizes.size(); ++rank)
              for (std::uint64_t n = 0; n < sizes[rank]; n += message.size())
              {
                MPI_Status status;
                int size;
                MPI_Probe(int(rank), tag, communicator, &status);
                MPI_Get_count(&status, MPI_CHAR, &size);
                message.resize(size);
                MPI_Recv(message.data(), size, MPI_CHAR, int(rank), tag,
                         communicator, MPI_STATUS_IGNORE);
                buffer.sputn(message.data(), size);
              }
            if (!buffer.close(false))
              throw RunError(write_failure(file, buffer.error()));
          });
    }

    /** Truncates a file to the length recorded in a checkpoint. */
    void cut(const std::string &file, const std::uint64_t size)
    {
      std::error_code error;
      const std::uintmax_t present = fs::file_size(file, error);
      if (error || present < size)
        throw InputError("the file '" + file
                         + "' is not there or shorter than when the checkpoint "
                           "was written, so its fields cannot be continued. "
                           "Put it back, or start anew without --resume.");
      fs::resize_file(file, size, error);
      if (error)
        throw RunError(write_failure(file, error.value()));
    }
  } // namespace

  XdmfWriter::XdmfWriter(const std::string &directory, const std::string &name,
                         const MPI_Comm communicator)
    : directory(directory), name(name), communicator(communicator),
      is_first(dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
  {
  }

  std::string XdmfWriter::data_file(const unsigned int number) const
  {
    return name + (number == 0 ? "" : "_" + std::to_string(number)) + ".bin";
  }

  void XdmfWriter::start()
  {
    const std::string begin = directory + "/", text = begin + name + ".xdmf";
    if (text_size == 0)
    {
      const std::string head = "<?xml version=\"1.0\"?>\n<Xdmf Version=\"2.0\">"
                               "\n<Domain>\n<Grid Name=\""
                               + name
                               + "\" GridType=\"Collection\" "
                                 "CollectionType=\"Temporal\">\n";
      write_text(begin + data_file(0), "");
      write_text(text, head + closing);
      text_size = head.size();
    }
    else
    {
      cut(begin + data_file(file_number), data_size);
      cut(text, text_size);
      write_text_end("");
    }
    std::error_code ignored;
    for (unsigned int number = file_number + 1;
         fs::remove(begin + data_file(number), ignored); ++number)
      ;
  }

  void XdmfWriter::write_text_end(const std::string &text)
  {
    // At once and over the last closing tags: whoever reads it meanwhile, or
    // after an interruption, finds them.
    const std::string file = directory + "/" + name + ".xdmf",
                      all  = text + closing;
    const int descriptor   = ::open(file.c_str(), O_WRONLY | O_CLOEXEC);
    const bool is_written
        = descriptor >= 0
          && ::pwrite(descriptor, all.data(), all.size(), off_t(text_size))
                 == ssize_t(all.size());
    const int reason = errno;
    if (descriptor >= 0)
      ::close(descriptor);
    if (!is_written)
      throw RunError(write_failure(file, reason));
    text_size += text.size();
  }

  void XdmfWriter::write(VtuGrid grid)
  {
    complete(grid);
    const std::vector<Element> elements = elements_of(grid);
    std::uint64_t size                  = 0;
    for (const Element &element : elements)
      size += element.bytes.size();
    if (data_size + dealii::Utilities::MPI::sum(size, communicator)
            > largest_file
        && data_size > 0)
    {
      ++file_number;
      data_size = 0;
      places.clear();
    }

    const auto is_known = [&](const Element &element)
    {
      const auto last = places.find(element.tag);
      return last != places.end() && last->second.hash == element.hash
             && last->second.size == element.bytes.size();
    };
    std::vector<std::string_view> arrays;
    size = 0;
    for (const Element &element : elements)
      if (!is_known(element))
      {
        arrays.push_back(element.bytes);
        size += element.bytes.size();
      }
    const auto sizes = dealii::Utilities::MPI::all_gather(communicator, size);
    append(arrays, sizes, is_first, communicator,
           directory + "/" + data_file(file_number));

    const auto rank = dealii::Utilities::MPI::this_mpi_process(communicator);
    std::uint64_t end
        = std::accumulate(sizes.begin(), sizes.begin() + rank, data_size);
    data_size = std::accumulate(sizes.begin(), sizes.end(), data_size);
    std::map<std::string, Place> now;
    std::string xml;
    for (const Element &element : elements)
    {
      Place place{ element.hash, element.bytes.size(), end };
      if (is_known(element))
        place = places[element.tag];
      else
        end += place.size;
      now[element.tag] = place;
      xml += xml_of(element, place.offset, data_file(file_number));
    }
    places = std::move(now);
    if (!xml.empty())
      xml = "<Grid Name=\"" + std::to_string(rank)
            + "\" GridType=\"Uniform\">\n" + xml + "</Grid>\n";
    const auto pieces = dealii::Utilities::MPI::gather(communicator, xml);
    all_or_none<RunError>(
        communicator,
        [&]()
        {
          if (is_first)
            write_text_end(
                "<Grid Name=\"" + name
                + "\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
                  "<Time Value=\""
                + shortest_text(grid.time) + "\"/>\n"
                + std::accumulate(pieces.begin(), pieces.end(), std::string())
                + "</Grid>\n");
        });
  }
} // namespace quoin
