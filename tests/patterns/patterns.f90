! SPDX-License-Identifier: BSD-3-Clause
!> Random sparse symmetric matrices through the Cholesky factor: those that run to their end have
!> a residual of rounding, those that fail do so where they are not definite, and entries stand
!> where elimination brings them forth. A seed and a number make a matrix again.
!>
!> Usage: patterns small|larger first last step [seed]
!> takes matrices first, first + step, .. of up to 12 columns, or of 13 to some hundreds, and
!> stops at the first that offends, which it prints; patterns small 7 7 1 takes the seventh alone.
program patterns
   use, intrinsic :: iso_fortran_env, only: error_unit, int64
   use flexact_cholesky, only: cholesky_t
   use flexact_cholesky_oracle, only: lower_t, analyse_for, factorise_by
   use flexact_error, only: error_t
   use flexact_kinds, only: wp
   use flexact_random_patterns, only: draw_t, draw_small, draw_larger
   use flexact_pattern_checks, only: offence_of
   implicit none
   character(len=16) :: word
   integer(int64) :: first, last, step, seed, number, done, failures
   logical :: is_small

   call get_command_argument(1, word)
   is_small = word == 'small'
   first = whole(2, 1_int64)
   last = whole(3, 1_int64)
   step = whole(4, 1_int64)
   seed = whole(5, 2024_int64)
   done = 0
   failures = 0
   do number = first, last, step
      call take(number)
      done = done + 1
      if (modulo(done, max(1_int64, (last - first)/step/20)) == 0) call say('')
   end do
   call say(', all right')

contains

   integer(int64) function whole(i, absent)
      integer, intent(in) :: i
      integer(int64), intent(in) :: absent
      character(len=24) :: text
      integer :: status

      whole = absent
      call get_command_argument(i, text)
      if (len_trim(text) == 0) return
      read (text, *, iostat=status) whole
      if (status /= 0) error stop 'usage: patterns small|larger first last step [seed]'
   end function whole

   subroutine take(number)
      integer(int64), intent(in) :: number
      type(draw_t) :: draw
      type(cholesky_t) :: factor
      type(error_t), allocatable :: error
      character(len=:), allocatable :: offence
      integer :: failed

      if (is_small) then
         call draw_small(seed, number, draw)
      else
         call draw_larger(seed, number, draw)
      end if
      call analyse_for(draw%threads, draw%lower, draw%order, factor, error)
      if (.not. allocated(error)) call factorise_by(draw%threads, factor, draw%lower%value, failed, error)
      offence = 'an error'
      if (.not. allocated(error)) offence = offence_of(draw, factor, failed)
      if (failed > 0) failures = failures + 1
      if (len(offence) == 0) return
      write (error_unit, '(a, i0, a, i0, 3a)') 'matrix ', number, ' of seed ', seed, ': ', offence, ':'
      call print_matrix(draw)
      error stop 1
   end subroutine take

   subroutine print_matrix(draw)
      type(draw_t), intent(in) :: draw
      integer :: j, e

      write (error_unit, '(a, i0, a, i0, a)') 'columns ', draw%lower%n, ', threads ', draw%threads, ', order (from 0):'
      write (error_unit, '(20(i0, 1x))') draw%order
      write (error_unit, '(a)') 'row, column (from 0), value:'
      do j = 1, draw%lower%n
         do e = draw%lower%start(j) + 1, draw%lower%start(j + 1)
            write (error_unit, '(i0, 1x, i0, 1x, es24.16)') draw%lower%place(e), j - 1, draw%lower%value(e)
         end do
      end do
   end subroutine print_matrix

   subroutine say(words)
      character(len=*), intent(in) :: words
      write (*, '(a, 1x, i0, a, i0, 2a)') trim(word), done, ' matrices, of which ', failures, ' not definite', words
      flush (6)
   end subroutine say
end program patterns
