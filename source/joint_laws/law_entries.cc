// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#include <quoin/base/parameter_entries.h>
#include <quoin/base/unread_parameters.h>
#include <quoin/joint_laws/joint_law.h>
#include <quoin/joint_laws/law_entries.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace quoin
{
  namespace
  {
    using dealii::Patterns::Anything;
    using dealii::Patterns::Double;

    /** "'a', 'b' or 'c'" */
    std::string quoted(const std::vector<std::string> &words)
    {
      std::string text;
      for (unsigned int i = 0; i < words.size(); ++i)
        text += (i == 0                 ? "'"
                 : i + 1 < words.size() ? "', '"
                                        : "' or '")
                + words[i];
      return text + "'";
    }
  } // namespace

  LawEntries::LawEntries(const ParameterSection &section)
    : section(&section), word(section.text("Law"))
  {
  }

  LawEntries LawEntries::all()
  {
    LawEntries entries;
    for_each_law(
        [&](const auto *law)
        {
          using Law = std::decay_t<decltype(*law)>;
          for (const LawName &name : Law::names)
          {
            entries.names.push_back(name);
            entries.word = name.word;
            Law::read(entries);
          }
        });
    return entries;
  }

  void LawEntries::declare(dealii::ParameterHandler &prm)
  {
    const LawEntries laws = all();
    std::string pattern, sentence = "Constitutive law of the joints. ";
    for (const LawName &name : laws.names)
    {
      sentence += (pattern.empty() ? "" : "; ") + std::string(name.word) + ": "
                  + name.sentence;
      pattern += (pattern.empty() ? "" : "|") + std::string(name.word);
    }
    prm.declare_entry("Law", laws.names.front().word,
                      dealii::Patterns::Selection(pattern), sentence + ".");
    for (const Entry &entry : laws.entries)
      prm.declare_entry(entry.name, entry.value, *entry.pattern,
                        laws.description(entry));
  }

  std::string LawEntries::description(const Entry &entry) const
  {
    const Note &first = entry.notes.front();
    std::string text  = first.sentence;
    text.front()      = std::toupper(text.front());
    if (entry.notes.size() == 1 && first.laws.size() < names.size())
      text += "; read if 'Law' is " + quoted(first.laws);
    for (unsigned int i = 1; i < entry.notes.size(); ++i)
      text += "; " + entry.notes[i].sentence + " if 'Law' is "
              + quoted(entry.notes[i].laws);
    return text + (entry.unit.empty() ? "." : " [" + entry.unit + "]");
  }

  void LawEntries::refuse_unread() const
  {
    const LawEntries others = all();
    std::vector<SelectiveParameter> table;
    for (const Entry &entry : others.entries)
      if (entry.readers.front() == others.names.front().word)
        table.push_back({ entry.name, entry.value, entry.readers });
    quoin::refuse_unread(*section, "Law", table);
  }

  void LawEntries::positive(const std::string &name, double &value,
                            const std::string &sentence,
                            const std::string &unit)
  {
    if (reads())
      value = section->positive(name);
    else
      collect(name, default_text({ value }), Double(), sentence, unit);
  }

  void LawEntries::nonnegative(const std::string &name, double &value,
                               const std::string &sentence,
                               const std::string &unit)
  {
    if (reads())
      value = section->nonnegative(name);
    else
      collect(name, default_text({ value }), Double(), sentence, unit);
  }

  void LawEntries::within(const std::string &name, double &value,
                          const double low, const double high,
                          const std::string &sentence, const std::string &unit)
  {
    if (reads())
      value = section->within(name, low, high);
    else
      collect(name, default_text({ value }), Double(), sentence, unit);
  }

  void LawEntries::positive_or_none(const std::string &name, double &value,
                                    const std::string &sentence,
                                    const std::string &unit)
  {
    if (!reads())
      return collect(name, "none", Anything(), sentence, unit);
    value = std::numeric_limits<double>::infinity();
    if (section->text(name) == "none")
      return;
    value = section->numbers<1>(name).front();
    check(value > 0. && std::isfinite(value), name,
          "must be positive, or 'none'.");
  }

  bool LawEntries::angle_or_same(const std::string &name, double &value,
                                 const std::string &sentence)
  {
    if (!reads())
      collect(name, "same", Anything(), sentence, "deg");
    else if (section->text(name) != "same")
    {
      value = section->numbers<1>(name).front();
      return true;
    }
    return false;
  }

  void LawEntries::either(const std::string &name, bool &value,
                          const std::string &first, const std::string &second,
                          const std::string &sentence)
  {
    if (reads())
      value = section->text(name) == second;
    else
      collect(name, first, dealii::Patterns::Selection(first + "|" + second),
              sentence, "");
  }

  void LawEntries::zero(const std::string &name, const std::string &why)
  {
    if (reads())
      check(section->nonnegative(name) == 0., name, why);
    else
      ignore(name);
  }

  void LawEntries::ignore(const std::string &name)
  {
    if (!reads())
      entry(name).readers.push_back(word);
  }

  void LawEntries::check(const bool is_right, const std::string &name,
                         const std::string &why) const
  {
    if (reads() && !is_right)
      section->fail(name, why);
  }

  void LawEntries::check_residual_angle(const double residual,
                                        const double peak,
                                        const bool loses_cohesion) const
  {
    if (loses_cohesion)
      check(residual >= 0. && residual <= 89., "Residual friction angle",
            "must lie between 0 and 89 degrees, or be 'same'.");
    else
      check(residual >= 0. && residual <= peak, "Residual friction angle",
            "must lie between 0 and 'Friction angle', or be 'same', as the "
            "joint loses no cohesion: the failed joint would be stronger at "
            "any pressure.");
  }

  void LawEntries::refuse_numbers(const std::vector<std::string> &names,
                                  const std::string &chooser) const
  {
    if (reads())
      for (const std::string &name : names)
        quoin::refuse_unread(*section, chooser,
                             { { name, "0", { "a number" } } });
  }

  LawEntries::Entry &LawEntries::entry(const std::string &name)
  {
    const auto same  = [&](const Entry &entry) { return entry.name == name; };
    const auto found = std::find_if(entries.begin(), entries.end(), same);
    if (found != entries.end())
      return *found;
    entries.emplace_back();
    entries.back().name = name;
    return entries.back();
  }

  void LawEntries::collect(const std::string &name, const std::string &value,
                           const dealii::Patterns::PatternBase &pattern,
                           const std::string &sentence, const std::string &unit)
  {
    Entry &own = entry(name);
    AssertThrow(own.notes.empty() || (own.value == value && own.unit == unit),
                dealii::ExcMessage("Joint laws disagree on the default or the "
                                   "unit of '"
                                   + name + "'."));
    own.value   = value;
    own.unit    = unit;
    own.pattern = pattern.clone();
    own.readers.push_back(word);
    for (Note &note : own.notes)
      if (note.sentence == sentence)
      {
        note.laws.push_back(word);
        return;
      }
    own.notes.push_back({ { word }, sentence });
  }
} // namespace quoin
