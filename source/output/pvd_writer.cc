// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/output/atomic_file.h>
#include <quoin/output/csv_table.h>
#include <quoin/output/pvd_writer.h>

namespace quoin
{
  void PvdWriter::add(const double time, const std::string &file,
                      const unsigned int part)
  {
    Record record;
    record.time = time;
    record.file = file;
    record.part = part;
    records.push_back(record);
  }

  void PvdWriter::write() const
  {
    AtomicFile file(path);
    std::ostream &out = file.stream();
    out << "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"Collection\" version=\"0.1\" "
           "byte_order=\"LittleEndian\">\n<Collection>\n";
    for (const Record &record : records)
      out << "<DataSet timestep=\"" << shortest_text(record.time)
          << "\" part=\"" << record.part << "\" file=\"" << record.file
          << "\"/>\n";
    out << "</Collection>\n</VTKFile>\n";
    file.commit();
  }
} // namespace quoin
