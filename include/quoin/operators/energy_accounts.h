// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_energy_accounts_h
#define quoin_operators_energy_accounts_h

namespace quoin
{
  /** On which side of the energy balance an account stands. */
  enum class EnergyKind
  {
    given,     /**< work done on the model */
    dissipated /**< energy dissipated or radiated */
  };

  struct EnergyAccounts;

  /** An account of the energy balance: a column of energies.csv. */
  struct EnergyAccount
  {
    const char *name; /**< of the column, without its unit */
    EnergyKind kind;
    double EnergyAccounts::*value; /**< [J] */
  };

  /**
   * Work and energy accumulated since the start of the run [J]. Each work is
   * the exact trapezoidal one of the central difference scheme, so that with
   * elastic forces the balance closes to rounding.
   *
   * A new account needs a member and a line in energy_accounts: from that line
   * follow sums over MPI processes, checkpoints, the balance and the column of
   * energies.csv.
   */
  struct EnergyAccounts
  {
    double external = 0.; /**< done by loads and prescribed motion */
    double friction = 0.; /**< dissipated in slip and dilation of joints */
    double fracture = 0.; /**< lost when joints break */
    double crushing = 0.; /**< dissipated by crushed joints */
    double plastic  = 0.; /**< dissipated by blocks that yield */
    double damping = 0.; /**< dissipated by local, adaptive, Rayleigh damping */
    double viscous = 0.; /**< left through viscous boundaries */
    double contact = 0.; /**< what contacts lost without work */
    double radiated = 0.; /**< radiated into boundary elements */

    EnergyAccounts &operator+=(const EnergyAccounts &other);

    /** Sum of the accounts of @p kind [J]. */
    double sum(EnergyKind kind) const;

    template <typename Archive>
    void serialize(Archive &archive, unsigned int);
  };

  /** All accounts, in the order of the columns of energies.csv. */
  inline constexpr EnergyAccount energy_accounts[] = {
    { "friction", EnergyKind::dissipated, &EnergyAccounts::friction },
    { "fracture", EnergyKind::dissipated, &EnergyAccounts::fracture },
    { "crushing", EnergyKind::dissipated, &EnergyAccounts::crushing },
    { "plastic", EnergyKind::dissipated, &EnergyAccounts::plastic },
    { "damping", EnergyKind::dissipated, &EnergyAccounts::damping },
    { "viscous", EnergyKind::dissipated, &EnergyAccounts::viscous },
    { "contact", EnergyKind::dissipated, &EnergyAccounts::contact },
    { "radiated", EnergyKind::dissipated, &EnergyAccounts::radiated },
    { "external", EnergyKind::given, &EnergyAccounts::external },
  };

  inline EnergyAccounts &EnergyAccounts::operator+=(const EnergyAccounts &other)
  {
    for (const EnergyAccount &account : energy_accounts)
      this->*account.value += other.*account.value;
    return *this;
  }

  inline double EnergyAccounts::sum(const EnergyKind kind) const
  {
    double result = 0.;
    for (const EnergyAccount &account : energy_accounts)
      if (account.kind == kind)
        result += this->*account.value;
    return result;
  }

  template <typename Archive>
  void EnergyAccounts::serialize(Archive &archive, const unsigned int)
  {
    for (const EnergyAccount &account : energy_accounts)
      archive &this->*account.value;
  }
} // namespace quoin

#endif
