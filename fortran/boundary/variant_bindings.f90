! SPDX-License-Identifier: BSD-3-Clause
! What Python can call about many variants of a model; as in bindings.f90.

! Each of some variants of a model; wishes, position and class (as many as variants, or one
! for all), and what comes back, as run_variants says.
subroutine analyse_variants(room, variants, nn, ne, np, nc, nodes, places, elements, vectors, wishes, position, class, facts)
   use iso_c_binding
   use flexact_exchange, only: unpack_model
   use flexact_model, only: model_t
   use flexact_variant_exchange, only: run_variants
   implicit none
!f2py threadsafe
   integer(c_int), intent(in) :: room, variants, nn, ne, np, nc
   integer(c_int), intent(in) :: nodes(5, nn), elements(12, ne)
   real(c_double), intent(in) :: places(4, nn), vectors(3, ne)
   real(c_double), intent(in) :: wishes(7), position(3, nn, np)
   integer(c_int), intent(in) :: class(6, ne, nc)
   real(c_double), intent(inout) :: facts(room, variants)
   type(model_t) :: model

   call unpack_model(nodes, places, elements, vectors, model)
   call run_variants(model, wishes, position, class, facts)
end subroutine analyse_variants
