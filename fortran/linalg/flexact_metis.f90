! SPDX-License-Identifier: BSD-3-Clause
!> The nested dissection of METIS (Karypis and Kumar, SIAM J. Sci. Comput. 20, 1998, pp. 359-392),
!> where the build has it. Indices count from 0; graphs are lower triangles, column by column.
module flexact_metis
   use, intrinsic :: iso_c_binding, only: c_int
   implicit none
   private
   public :: metis_is_there, metis_order

   interface
      function metis_is_there() bind(c, name='flexact_metis_is_there') result(is_there)
         import :: c_int
         integer(c_int) :: is_there
      end function metis_is_there

      !> 0 with a fill-reducing order, or -1 where memory does not suffice.
      function metis_order(n, start, place, order) bind(c, name='flexact_metis_order') result(status)
         import :: c_int
         integer(c_int), value :: n
         integer(c_int), intent(in) :: start(*), place(*)
         integer(c_int), intent(out) :: order(*)
         integer(c_int) :: status
      end function metis_order
   end interface
end module flexact_metis
