! SPDX-License-Identifier: BSD-3-Clause
!> Arithmetic modulo a prime: by FLINT (https://flintlib.org) where the build has it, else by
!> flexact_modular.c.
module flexact_flint
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   implicit none
   private
   public :: flint_is_there, flint_prime, flint_times, flint_inverse, flint_rank, flint_echelon

   interface
      !> 0 only without FLINT and with a compiler that has no integers of 128 bits.
      function flint_is_there() bind(c, name='flexact_flint_is_there') result(is_there)
         import :: c_int
         integer(c_int) :: is_there
      end function flint_is_there

      !> A prime from 2**60 to 2**61, as likely as any other; the same for the same seed.
      pure function flint_prime(seed) bind(c, name='flexact_flint_prime') result(prime)
         import :: c_int64_t
         integer(c_int64_t), value :: seed
         integer(c_int64_t) :: prime
      end function flint_prime

      !> a*b modulo a modulus below 2**63; a and b are below it and not negative.
      pure function flint_times(a, b, modulus) bind(c, name='flexact_flint_times') result(product)
         import :: c_int64_t
         integer(c_int64_t), value :: a, b, modulus
         integer(c_int64_t) :: product
      end function flint_times

      !> 1/a modulo a prime; a is not zero.
      pure function flint_inverse(a, prime) bind(c, name='flexact_flint_inverse') result(inverse)
         import :: c_int64_t
         integer(c_int64_t), value :: a, prime
         integer(c_int64_t) :: inverse
      end function flint_inverse

      !> The rank modulo a prime of a matrix given as (columns, rows); -1 where there is no room.
      pure function flint_rank(rows, columns, entry, modulus) bind(c, name='flexact_flint_rank') result(rank)
         import :: c_int, c_int64_t
         integer(c_int), value :: rows, columns
         integer(c_int64_t), intent(in) :: entry(*)
         integer(c_int64_t), value :: modulus
         integer(c_int) :: rank
      end function flint_rank

      !> The reduced echelon form modulo a prime in place of a matrix given as (columns, rows);
      !> its rank.
      function flint_echelon(rows, columns, entry, modulus) bind(c, name='flexact_flint_echelon') result(rank)
         import :: c_int, c_int64_t
         integer(c_int), value :: rows, columns
         integer(c_int64_t), intent(inout) :: entry(*)
         integer(c_int64_t), value :: modulus
         integer(c_int) :: rank
      end function flint_echelon
   end interface
end module flexact_flint
