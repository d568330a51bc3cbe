// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_joint_laws_law_entries_h
#define quoin_joint_laws_law_entries_h

#include <quoin/base/parameter_section.h>
#include <quoin/joints/joint_point.h>

#include <memory>
#include <string>
#include <vector>

namespace quoin
{
  /**
   * The parameters of joint laws in a subsection of 'Joints'. A law names each
   * of its parameters once, in its read(): where a file is read, that gives
   * the variable its value or refuses it (InputError); where the parameters of
   * all laws are collected, it notes the entry, with the value that the
   * variable has as its default.
   *
   * Laws may share an entry. Each has a sentence of its own, and the
   * description in the parameter file is made of them all.
   */
  class LawEntries
  {
  public:
    /** Entries of the law that @p section names. */
    explicit LawEntries(const ParameterSection &section);

    /** Declares 'Law' and the entries of all laws. */
    static void declare(dealii::ParameterHandler &prm);

    /**
     * Refuses, of the section that is read, what the first law reads and the
     * one chosen does not. What belongs to other laws alone may stay, so that
     * a file can change the law of one that it includes.
     */
    void refuse_unread() const;

    // Parameters, each with its @p sentence and its @p unit.

    void positive(const std::string &name, double &value,
                  const std::string &sentence, const std::string &unit);
    void nonnegative(const std::string &name, double &value,
                     const std::string &sentence, const std::string &unit);
    /** A number in [@p low, @p high]. */
    void within(const std::string &name, double &value, double low, double high,
                const std::string &sentence, const std::string &unit);
    /** A positive number; infinity for the word 'none'. */
    void positive_or_none(const std::string &name, double &value,
                          const std::string &sentence, const std::string &unit);
    /** An angle [deg], or the word 'same', which leaves @p value: then false.
     */
    bool angle_or_same(const std::string &name, double &value,
                       const std::string &sentence);
    /** One of two words; whether it is the @p second. */
    void either(const std::string &name, bool &value, const std::string &first,
                const std::string &second, const std::string &sentence);

    /** A parameter of other laws that must be 0 for this one; @p why. */
    void zero(const std::string &name, const std::string &why);
    /** A parameter of other laws that may be given for this one as well: it is
        not read. */
    void ignore(const std::string &name);

    /** Refuses the value of @p name unless it @p is_right. */
    void check(bool is_right, const std::string &name,
               const std::string &why) const;

    /** Refuses a @p residual friction angle [deg] that is negative or, unless
        the joint loses cohesion as it fails, above that of the @p peak: the
        failed joint would be stronger at any pressure. */
    void check_residual_angle(double residual, double peak,
                              bool loses_cohesion) const;

    /** Refuses what is given of @p names, numbers that are 0 by default: the
        value of @p chooser leaves them without effect. */
    void refuse_numbers(const std::vector<std::string> &names,
                        const std::string &chooser) const;

    /** The word for the law. */
    const std::string &law() const
    {
      return word;
    }
    /** Whether a file is read. */
    bool reads() const
    {
      return section != nullptr;
    }

  private:
    LawEntries() = default;
    /** Entries of all laws, collected. */
    static LawEntries all();

    /** Description of an entry by laws that share it. */
    struct Note
    {
      std::vector<std::string> laws;
      std::string sentence;
    };
    struct Entry
    {
      std::string name, value, unit;
      std::shared_ptr<const dealii::Patterns::PatternBase> pattern;
      std::vector<Note> notes;
      std::vector<std::string> readers; /**< laws */
    };

    void collect(const std::string &name, const std::string &value,
                 const dealii::Patterns::PatternBase &pattern,
                 const std::string &sentence, const std::string &unit);
    Entry &entry(const std::string &name);
    std::string description(const Entry &entry) const;

    const ParameterSection *section = nullptr;
    std::string word;
    std::vector<Entry> entries;
    std::vector<LawName> names;
  };
} // namespace quoin

#endif
