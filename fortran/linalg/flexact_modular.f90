! SPDX-License-Identifier: BSD-3-Clause
!> Arithmetic modulo a prime, which flexact_modular.c does.
module flexact_modular
   use, intrinsic :: iso_c_binding, only: c_int, c_int64_t
   implicit none
   private
   public :: random_prime, modular_product, modular_inverse, modular_multiples, dense_modular_rank, modular_echelon

   interface
      !> A prime from 2**60 to 2**61, as likely as any other; the same for the same seed.
      pure function random_prime(seed) bind(c, name='flexact_random_prime') result(prime)
         import :: c_int64_t
         integer(c_int64_t), value :: seed
         integer(c_int64_t) :: prime
      end function random_prime

      !> a*b modulo a modulus below 2**63; a and b are below it and not negative.
      pure function modular_product(a, b, modulus) bind(c, name='flexact_modular_product') result(product)
         import :: c_int64_t
         integer(c_int64_t), value :: a, b, modulus
         integer(c_int64_t) :: product
      end function modular_product

      !> 1/a modulo a prime; a is not zero.
      pure function modular_inverse(a, prime) bind(c, name='flexact_modular_inverse') result(inverse)
         import :: c_int64_t
         integer(c_int64_t), value :: a, prime
         integer(c_int64_t) :: inverse
      end function modular_inverse

      !> Multiply numbers with a factor over 2**64 modulo an odd modulus below 2**63; they and
      !> the factor are below it and not negative.
      pure subroutine modular_multiples(count, number, factor, modulus) bind(c, name='flexact_modular_multiples')
         import :: c_int, c_int64_t
         integer(c_int), value :: count
         integer(c_int64_t), intent(inout) :: number(*)
         integer(c_int64_t), value :: factor, modulus
      end subroutine modular_multiples

      !> The rank modulo a prime of a matrix given as (columns, rows); -1 where there is no room.
      pure function dense_modular_rank(rows, columns, entry, modulus) bind(c, name='flexact_dense_modular_rank') result(rank)
         import :: c_int, c_int64_t
         integer(c_int), value :: rows, columns
         integer(c_int64_t), intent(in) :: entry(*)
         integer(c_int64_t), value :: modulus
         integer(c_int) :: rank
      end function dense_modular_rank

      !> The reduced echelon form modulo a prime in place of a matrix given as (columns, rows);
      !> its rank.
      function modular_echelon(rows, columns, entry, modulus) bind(c, name='flexact_modular_echelon') result(rank)
         import :: c_int, c_int64_t
         integer(c_int), value :: rows, columns
         integer(c_int64_t), intent(inout) :: entry(*)
         integer(c_int64_t), value :: modulus
         integer(c_int) :: rank
      end function modular_echelon
   end interface
end module flexact_modular
