// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 The quoin authors

#ifndef quoin_operators_energy_accounts_h
#define quoin_operators_energy_accounts_h

namespace quoin
{
  /** On which side of the energy balance an account stands. */
  enum class EnergyKind
  {
    stored,     /**< recoverable or kinetic energy at one time */
    dissipated, /**< energy dissipated or radiated so far */
    given       /**< work done on the model so far */
  };

// All accounts of the energy balance, in the order of the columns of
// energies.csv: member of EnergyAccounts, kind, column without its unit. A new
// account is a line here, from which sums over MPI processes, checkpoints, the
// balance and the column of energies.csv follow.
// clang-format off
#define QUOIN_ENERGY_ACCOUNTS(account)                                         \
  account(kinetic, stored, "kinetic"),        /* nodes and rigid blocks */     \
  account(strain, stored, "strain"),          /* deformable blocks */          \
  account(joint, stored, "joint"),            /* joints and contacts */        \
  account(reinforcement, stored, "reinforcement"), /* bars and their bond */   \
  account(friction, dissipated, "friction"),  /* slip, dilation of joints */   \
  account(fracture, dissipated, "fracture"),  /* joints that break */          \
  account(crushing, dissipated, "crushing"),  /* crushed joints */             \
  account(plastic, dissipated, "plastic"),    /* blocks that yield */          \
  account(damping, dissipated, "damping"),    /* local, adaptive, Rayleigh */  \
  account(viscous, dissipated, "viscous"),    /* viscous boundaries */         \
  account(contact, dissipated, "contact"),    /* lost without work */          \
  account(radiated, dissipated, "radiated"),  /* boundary elements */          \
  account(far_field, stored, "far field"),    /* static boundary elements */   \
  account(external, given, "external")        /* loads, prescribed motion */
  // clang-format on

  struct EnergyAccounts;

  /** An account of the energy balance: a column of energies.csv. */
  struct EnergyAccount
  {
    const char *name; /**< of the column, without its unit */
    EnergyKind kind;
    double EnergyAccounts::*value; /**< [J] */
  };

  /**
   * Energies of QUOIN_ENERGY_ACCOUNTS [J]. Works are the exact trapezoidal ones
   * of the central difference scheme, so that with elastic forces the balance
   * closes to rounding.
   *
   * In State::energy each operator accumulates what it dissipates or gives
   * since the start of the run; what it stores, which follows from the state,
   * it adds in ForceOperator::add_stored_energy() when it is asked for.
   */
  struct EnergyAccounts
  {
#define QUOIN_ENERGY_MEMBER(member, kind, name) member = 0.
    double QUOIN_ENERGY_ACCOUNTS(QUOIN_ENERGY_MEMBER);
#undef QUOIN_ENERGY_MEMBER

    EnergyAccounts &operator+=(const EnergyAccounts &other);

    /** Sum of the accounts of @p kind [J]. */
    double sum(EnergyKind kind) const;

    /** Archives what has accumulated. */
    template <typename Archive>
    void serialize(Archive &archive, unsigned int);
  };

  /** All accounts, in the order of the columns of energies.csv. */
  inline constexpr EnergyAccount energy_accounts[] = {
#define QUOIN_ENERGY_LINE(member, kind, name)                                  \
  {                                                                            \
    name, EnergyKind::kind, &EnergyAccounts::member                            \
  }
    QUOIN_ENERGY_ACCOUNTS(QUOIN_ENERGY_LINE)
#undef QUOIN_ENERGY_LINE
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
      if (account.kind != EnergyKind::stored)
        archive &this->*account.value;
  }
} // namespace quoin

#endif
