! SPDX-License-Identifier: BSD-3-Clause
!> Large arrays that have just been allocated, in large pages: see flexact_pages.c.
module flexact_pages
   use, intrinsic :: iso_c_binding, only: c_loc, c_ptr, c_size_t
   use flexact_kinds, only: wp
   implicit none
   private
   public :: use_large_pages

   interface
      subroutine advise(memory, bytes) bind(c, name='flexact_use_large_pages')
         import :: c_ptr, c_size_t
         type(c_ptr), value :: memory
         integer(c_size_t), value :: bytes
      end subroutine advise
   end interface

contains

   !> To be called before anything is written there.
   subroutine use_large_pages(array)
      real(wp), intent(in), contiguous, target :: array(:)

      if (size(array) > 0) call advise(c_loc(array), storage_size(array)/8*size(array, kind=c_size_t))
   end subroutine use_large_pages
end module flexact_pages
