! SPDX-License-Identifier: BSD-3-Clause
!> What small changes of the geometry make of singular values.
program test_sensitivity
   use flexact_kinds, only: wp
   use flexact_model, only: model_t
   use flexact_slots, only: node_position, node_orientation, has_axis, is_position, slots
   use flexact_element_table, only: find_element_kind, element_kinds
   use flexact_jacobian, only: jacobian_t, make_jacobian
   use flexact_sensitivity, only: sensitivity_t, find_sensitivities
   use flexact_effects, only: geometry_t, make_geometry, find_effects
   use flexact_testing, only: tally_t
   use flexact_test_models, only: new_model, set_node, set_element, fix, release, twelve_trusses, folded_sheet
   implicit none
   type(tally_t) :: tally
   real(wp), parameter :: upright(4) = [1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]

   call a_bar_by_hand()
   call digits_of_a_bar()
   call a_hinge_turns_its_axis()
   call the_paper_misaligned()
   call changes_of_elements()
   call body_without_length()
   call nothing_where_no_geometry_counts()
   call tally%finish()

contains

   !> One bar from the origin to a free joint.
   function bar(q) result(model)
      real(wp), intent(in) :: q(3)
      type(model_t) :: model

      model = new_model(2, 1)
      call set_node(model, 1, node_position, [0.0_wp, 0.0_wp, 0.0_wp])
      call set_node(model, 2, node_position, q)
      call set_element(model, 1, find_element_kind('TRUSS'), [1, 0, 2, 0])
      call fix(model, [1])
   end function bar

   function one_pair(model, u, v) result(found)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: u(:), v(:)
      type(sensitivity_t) :: found
      type(sensitivity_t) :: every(1)

      call find_sensitivities(model, reshape(u, [size(u), 1]), reshape(v, [size(v), 1]), reshape([1, 1], [2, 1]), every)
      found = every(1)
   end function one_pair

   !> D is the direction n of a bar along x, dn/dy = 1/l, and a turn about z by
   !> w turns n by w.
   subroutine a_bar_by_hand()
      type(sensitivity_t) :: found
      real(wp), parameter :: lengths(3) = [1.0e-9_wp, 2.0_wp, 1.0e9_wp]
      integer :: i

      do i = 1, size(lengths)
         found = one_pair(bar([lengths(i), 0.0_wp, 0.0_wp]), [1.0_wp], [0.0_wp, 1.0_wp, 0.0_wp])
         call tally%near([found%by_move*lengths(i), found%by_turn], [1.0_wp, 1.0_wp], 1.0e-9_wp, 'a bar')
         call tally%check(found%element == 1 .and. found%node > 0, 'and where')
         found = one_pair(bar([lengths(i), 0.0_wp, 0.0_wp]), [1.0_wp], [1.0_wp, 0.0_wp, 0.0_wp])
         call tally%check(found%node == 0 .and. found%element == 0, 'along the bar nothing changes')
      end do
   end subroutine a_bar_by_hand

   !> dn_x/dx = (1 - n_x**2)/l, and 0.5 is meant as it stands.
   subroutine digits_of_a_bar()
      real(wp), parameter :: x = 0.866_wp, y = 0.5_wp
      real(wp), parameter :: l = sqrt(x**2 + y**2), rate = (1 - (x/l)**2)/l
      type(sensitivity_t) :: found

      found = one_pair(bar([x, y, 0.0_wp]), [2.0_wp], [1.0_wp, 0.0_wp, 0.0_wp])
      call tally%near([found%lift_of_digits], [2*rate*0.5e-3_wp], 1.0e-12_wp, 'half a unit of the third digit')
      call tally%check(found%lift_of_bits > 0 .and. found%lift_of_bits < 1.0e-14_wp, 'and the last bits')
      found = one_pair(bar([sqrt(0.75_wp), 0.5_wp, 0.0_wp]), [1.0_wp], [1.0_wp, 0.0_wp, 0.0_wp])
      call tally%near([found%lift_of_digits], [0.0_wp], 0.0_wp, 'all digits are there')
   end subroutine digits_of_a_bar

   !> e1 takes the component of the rotation along the axis: turning the axis
   !> by w, a rotation across it counts by w. No node has a place.
   subroutine a_hinge_turns_its_axis()
      type(model_t) :: model
      type(sensitivity_t) :: found
      real(wp) :: u(3)

      model = new_model(2, 1)
      call set_node(model, 1, node_orientation, upright)
      call set_node(model, 2, node_orientation, upright)
      call set_element(model, 1, find_element_kind('HINGE'), [0, 1, 0, 2], [0.0_wp, 0.0_wp, 3.0_wp])
      call fix(model, [1])
      u = [1.0_wp, 0.0_wp, 0.0_wp]
      found = one_pair(model, u, [0.6_wp, 0.8_wp, 0.0_wp])
      call tally%near([found%by_turn, found%by_move], [1.0_wp, 0.0_wp], 1.0e-9_wp, 'a hinge')
      call tally%check(found%element == 1 .and. found%node == 0, 'only its axis')
   end subroutine a_hinge_turns_its_axis

   !> Fig. 2 of the paper with its motion and self-stress: moving joint E by d
   !> along its motion stretches the four bars there; by hand, with bars of
   !> length l, u' dD v = sum of u (dn . v) with dn = (d - (d . n) n)/l.
   subroutine the_paper_misaligned()
      type(model_t) :: model
      real(wp) :: u(12), v(12), by_node(3, 8), expected
      integer :: k, i

      model = twelve_trusses()
      u = sqrt(3.0_wp)/6*[1, -1, -1, 1, 1, -1, -1, 1, 1, -1, 1, -1]
      v = 0.0_wp
      v([2, 4, 8, 10]) = [-0.5_wp, -0.5_wp, 0.5_wp, 0.5_wp]
      by_node = 0.0_wp
      do k = 1, 12
         call add_bar(model, u(k), v, k, by_node)
      end do
      expected = maxval([(norm2(by_node(:, i)), i=1, 8)])
      associate (found => one_pair(model, u, v))
         call tally%check(expected > 0.1_wp, 'a misalignment counts')
         call tally%near([found%by_move], [expected], 1.0e-8_wp, 'the twelve trusses')
      end associate
   end subroutine the_paper_misaligned

   subroutine add_bar(model, u, v, k, by_node)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: u, v(12)
      integer, intent(in) :: k
      real(wp), intent(inout) :: by_node(3, 8)
      real(wp) :: offset(3), n(3), apart(3), effect(3)

      associate (p => model%element_node(1, k), q => model%element_node(3, k))
         offset = model%node_value(1:3, q) - model%node_value(1:3, p)
         n = offset/norm2(offset)
         apart = velocity(v, q) - velocity(v, p)
         effect = u*(apart - dot_product(n, apart)*n)/norm2(offset)
         by_node(:, q) = by_node(:, q) + effect
         by_node(:, p) = by_node(:, p) - effect
      end associate
   end subroutine add_bar

   function velocity(v, node)
      real(wp), intent(in) :: v(12)
      integer, intent(in) :: node
      real(wp) :: velocity(3)
      velocity = 0.0_wp
      if (node > 4) velocity = v(3*node - 14:3*node - 12)
   end function velocity

   !> Of every kind of element, with a vector and without one, against central differences of
   !> u' D v of an element whose node or vector stands elsewhere.
   subroutine changes_of_elements()
      real(wp), parameter :: vector(3) = [0.2_wp, 1.0_wp, 0.4_wp]
      integer :: kind

      do kind = 1, size(element_kinds)
         call changes_of(kind, vector*merge(1, 0, element_kinds(kind)%vector > 0))
         call changes_of(kind, -3*vector([3, 1, 2])*merge(1, 0, element_kinds(kind)%vector > 1))
      end do
   end subroutine changes_of_elements

   subroutine changes_of(kind, vector)
      integer, intent(in) :: kind
      real(wp), intent(in) :: vector(3)
      type(model_t) :: model
      type(geometry_t) :: geometry
      real(wp), parameter :: step = 1.0e-6_wp
      real(wp) :: u(6), v(12), effect(6), nothing(2), expected(6)
      integer :: i

      model = one_element(kind, vector)
      u = [0.7_wp, -0.4_wp, 0.9_wp, 0.3_wp, -0.8_wp, 0.5_wp]
      v = [(cos(3.0_wp*i), i=1, 12)]
      call make_geometry(model, 1, geometry)
      call find_effects(geometry, u, v, effect, nothing)
      expected = 0.0_wp
      do i = 1, 3
         if (model%element_node(3, 1) > 0) then
            if (has_axis(model%node_kind(3), i)) expected(i) = (moved(model, u, v, i, step) - moved(model, u, v, i, -step))/(2*step)
         end if
         if (any(abs(vector) > 0)) expected(3 + i) = (moved(model, u, v, 3 + i, step) - moved(model, u, v, 3 + i, -step))/(2*step)
      end do
      call tally%near(effect, expected, 1.0e-8_wp, element_kinds(kind)%keyword)
      call tally%check(all(nothing < 1.0e-6_wp), 'what is nothing is little')

   end subroutine changes_of

   !> u' D v of the one element with one number of the geometry changed.
   function moved(model, u, v, number, change) result(product)
      type(model_t), intent(in) :: model
      real(wp), intent(in) :: u(6), v(12), change
      integer, intent(in) :: number
      real(wp) :: product
      type(model_t) :: other

      other = model
      if (number <= 3) other%node_value(number, 3) = other%node_value(number, 3) + change
      if (number > 3) other%element_vector(number - 3, 1) = other%element_vector(number - 3, 1) + change
      product = dot_product(u, matmul(derivative_of(other), v))
   end function moved

   !> Nodes 1 to 4 in the slots of one element, as far as it has them.
   function one_element(kind, vector) result(model)
      integer, intent(in) :: kind
      real(wp), intent(in) :: vector(3)
      type(model_t) :: model
      real(wp), parameter :: place(3, 2) = reshape([0.1_wp, 0.2_wp, 0.3_wp, 1.3_wp, -0.2_wp, 0.9_wp], [3, 2])
      integer :: slot, node(slots)

      model = new_model(slots, 1)
      do slot = 1, slots
         associate (wanted => element_kinds(kind)%slot_kind(slot))
            node(slot) = merge(slot, 0, wanted > 0)
            if (is_position(wanted)) then
               call set_node(model, slot, wanted, place(:, (slot + 1)/2))
            else
               call set_node(model, slot, merge(wanted, node_orientation, wanted > 0), upright)
            end if
         end associate
      end do
      call set_element(model, 1, kind, node, vector)
   end function one_element

   function derivative_of(model) result(derivative)
      type(model_t), intent(in) :: model
      real(wp) :: derivative(6, 12)
      type(jacobian_t) :: jacobian
      integer :: i

      derivative = 0.0_wp
      call make_jacobian(model, model%node_value, jacobian)
      do i = 1, jacobian%entries
         derivative(jacobian%row(2, i), 3*(jacobian%column(1, i) - 1) + jacobian%column(2, i)) = jacobian%value(i)
      end do
   end function derivative_of

   !> q on p: with the body turning by w about z, q moved by d along x goes by
   !> w d along y, so that e2 changes by 1 for each unit of d.
   subroutine body_without_length()
      type(model_t) :: model
      type(sensitivity_t) :: found

      model = new_model(3, 1)
      call set_node(model, 1, node_position, [1.0_wp, 2.0_wp, 3.0_wp])
      call set_node(model, 2, node_orientation, upright)
      call set_node(model, 3, node_position, [1.0_wp, 2.0_wp, 3.0_wp])
      call set_element(model, 1, find_element_kind('PINBODY'), [1, 2, 3, 0])
      call fix(model, [1])
      found = one_pair(model, [0.0_wp, 1.0_wp, 0.0_wp], [0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp])
      call tally%near([found%by_move], [1.0_wp], 1.0e-9_wp, 'a body without length')
   end subroutine body_without_length

   !> Fig. 4 of the paper: the fold turns and the clamped ends carry moments
   !> whatever the angle, the lengths and the place.
   subroutine nothing_where_no_geometry_counts()
      type(sensitivity_t) :: found

      found = one_pair(folded_sheet(1.0_wp), [0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp]/sqrt(2.0_wp), &
                       [0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp])
      call tally%check(found%node == 0 .and. found%element == 0, 'a clamped fold stays what it is')
      call tally%near([found%lift_of_bits, found%lift_of_digits], [0.0_wp, 0.0_wp], 0.0_wp, 'with any rounding')
   end subroutine nothing_where_no_geometry_counts
end program test_sensitivity
