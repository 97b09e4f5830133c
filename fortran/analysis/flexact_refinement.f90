!> Singular values that are small beside the largest, made exact by one-sided
!> Jacobi rotations in quadruple precision. B = A V is formed for the computed
!> right vectors V, which are orthogonal to working precision, so that B has
!> the singular values of A to working precision relative to each. Its columns
!> are turned until they are orthogonal: their lengths are the values and their
!> directions the left vectors. V is close to what is wanted, so that most
!> angles are seen to be right in working precision, and few pairs are turned
!> (Demmel and Veselic, SIAM J. Matrix Anal. Appl. 13, 1992, pp. 1204-1245).
!>
!> Nothing is done where the compiler has no such precision, nor for matrices
!> above `largest_size`, nor where more than `most_flops` turned out to be
!> needed: such as dense ones of more than some 150 x 150. These are limits on
!> time; they count operations, so that results do not depend on the machine.
module flexact_refinement
   use flexact_kinds, only: wp
   use flexact_dense, only: status_fine, bring_to_one
   implicit none
   private
   public :: is_refinable, refine

   integer, parameter :: wanted = selected_real_kind(30)
   integer, parameter :: qp = merge(wanted, wp, wanted > 0)

   !> At some 60 ns each, about 1 s; 12 operations for each row of a pair.
   real(wp), parameter :: most_flops = 1.6e7_wp
   !> m n**2, in which the products are counted that form B. Square matrices may
   !> be 250 x 250.
   real(wp), parameter :: largest_size = 1.6e7_wp
   integer, parameter :: most_sweeps = 12
   !> Cosines up to here are right angles. Larger ones need no turn either where
   !> it would change neither value by more than the second of these, as a part
   !> of itself, nor right vectors by more than the third.
   real(wp), parameter :: right_angle = 2.0e-15_wp, same_value = 1.0e-17_wp, same_vector = 4.0e-15_wp
   !> A value is exact if it is so many times what rounding made of it, and zero
   !> if it is not even that.
   real(qp), parameter :: exact = 1.0e15_qp, zero = 16.0_qp

   !> The columns of B, their lengths, what rounding may have made of these, and
   !> the directions; a direction is zero where the column is within its noise.
   type :: columns_t
      real(qp), allocatable :: b(:, :), length(:), noise(:)
      real(wp), allocatable :: direction(:, :)
      real(wp) :: flops = 0.0_wp
   end type columns_t

contains

   !> Whether an m x n matrix, m >= n, is small enough, and numbers are at hand
   !> that have more digits.
   pure logical function is_refinable(m, n)
      integer, intent(in) :: m, n

      is_refinable = precision(1.0_qp) > precision(1.0_wp) .and. real(m, wp)*n*n <= largest_size
   end function is_refinable

   !> Improve the singular values (n), descending, of A (m, n), m >= n, and the
   !> right vectors (n, n) and left vectors (m, m) in their columns. What cannot
   !> be improved stays as it is. Left vectors of values within rounding beside
   !> the largest are only made orthogonal to the others. A is destroyed.
   pure subroutine refine(a, values, right, left)
      real(wp), intent(inout) :: a(:, :)
      real(wp), intent(inout) :: values(:), right(:, :)
      real(wp), intent(inout), optional :: left(:, :)
      real(wp), allocatable :: turned(:, :)
      logical, allocatable :: improved(:)
      type(columns_t) :: columns
      integer :: power, status, j
      logical :: done

      if (.not. is_refinable(size(a, 1), size(a, 2))) return
      call bring_to_one(a, power, status)
      if (status /= status_fine) return
      turned = right
      call multiply(a, turned, columns)
      call make_orthogonal(columns, turned, done)
      if (.not. done) return
      right = turned
      improved = columns%length >= exact*columns%noise .and. columns%length > 0
      do j = 1, size(values)
         if (improved(j)) values(j) = scale(real(columns%length(j), wp), power)
      end do
      if (present(left)) then
         improved = improved .and. values > epsilon(1.0_wp)*size(left, 1)*maxval(values)
         do j = 1, size(values)
            if (improved(j)) left(:, j) = columns%direction(:, j)
         end do
         call straighten(left, improved)
      end if
      call sort(values, right, left)
   end subroutine refine

   !> B = A V, and its noise, for columns of V that become of unit length.
   pure subroutine multiply(a, v, columns)
      real(wp), intent(in) :: a(:, :)
      real(wp), intent(inout) :: v(:, :)
      type(columns_t), intent(out) :: columns
      real(wp), allocatable :: noise(:, :)
      integer, allocatable :: row(:)
      real(qp) :: inverse
      integer :: m, n, i, j, k

      m = size(a, 1)
      n = size(a, 2)
      allocate (columns%b(m, n), source=0.0_qp)
      allocate (noise(m, n), source=0.0_wp)
      allocate (columns%length(n), columns%noise(n), columns%direction(m, n))
      do k = 1, n
         row = pack([(i, i=1, m)], a(:, k) /= 0)
         do j = 1, n
            columns%b(row, j) = columns%b(row, j) + real(a(row, k), qp)*v(k, j)
            noise(row, j) = noise(row, j) + abs(a(row, k)*v(k, j))
         end do
      end do
      do j = 1, n
         inverse = 1/root(sum(real(v(:, j), qp)**2))
         columns%b(:, j) = columns%b(:, j)*inverse
         columns%noise(j) = epsilon(inverse)*norm2(noise(:, j))
         call measure(columns, j)
      end do
   end subroutine multiply

   !> Length and direction of a column.
   pure subroutine measure(columns, j)
      type(columns_t), intent(inout) :: columns
      integer, intent(in) :: j
      real(qp) :: largest

      associate (b => columns%b(:, j), length => columns%length(j))
         largest = maxval(abs(real(b, wp)))
         length = 0.0_qp
         if (largest > tiny(1.0_wp)) length = largest*root(dot_product(b, b)/largest**2)
         columns%direction(:, j) = 0.0_wp
         if (length > zero*columns%noise(j)) columns%direction(:, j) = real(b, wp)/real(length, wp)
      end associate
   end subroutine measure

   !> Turn the columns, and V with them, until none is left that is not
   !> orthogonal to all others, which is soon as a rule.
   pure subroutine make_orthogonal(columns, v, done)
      type(columns_t), intent(inout) :: columns
      real(wp), intent(inout) :: v(:, :)
      logical, intent(out) :: done
      integer :: i, j, sweep

      do sweep = 1, most_sweeps
         done = .true.
         do j = 2, size(v, 2)
            do i = 1, j - 1
               if (is_right(columns, i, j)) cycle
               done = .false.
               call turn(columns, i, j, v)
               if (columns%flops > most_flops) return
            end do
         end do
         if (done) return
      end do
   end subroutine make_orthogonal

   !> Whether two columns need no turn.
   pure logical function is_right(columns, i, j)
      type(columns_t), intent(in) :: columns
      integer, intent(in) :: i, j
      real(wp) :: cosine, ratio, gap

      cosine = abs(dot_product(columns%direction(:, i), columns%direction(:, j)))
      is_right = cosine <= right_angle
      if (is_right) return
      associate (length => columns%length([i, j]))
         ratio = real(minval(length)/maxval(length), wp)
      end associate
      gap = 1 - ratio**2
      is_right = cosine**2 <= same_value*gap .and. cosine*ratio <= same_vector*gap
   end function is_right

   !> Turn two columns in their plane so that they become orthogonal.
   pure subroutine turn(columns, i, j, v)
      type(columns_t), intent(inout) :: columns
      integer, intent(in) :: i, j
      real(wp), intent(inout) :: v(:, :)
      !> One beside its square is nothing.
      real(qp), parameter :: large = 1.0e18_qp
      real(qp) :: product, ratio, tangent, c, s, former(size(columns%b, 1)), noise
      real(wp) :: vector(size(v, 1))

      associate (b => columns%b, length => columns%length)
         product = dot_product(b(:, i), b(:, j))
         if (.not. abs(product) > 0) return
         ratio = (length(j) - length(i))*(length(j) + length(i))/(2*product)
         if (abs(ratio) < large) then
            tangent = 1/(abs(ratio) + root(1 + ratio**2))
            if (ratio < 0) tangent = -tangent
         else
            tangent = 1/(2*ratio)
         end if
         c = 1/root(1 + tangent**2)
         s = c*tangent
         former = b(:, i)
         b(:, i) = c*former - s*b(:, j)
         b(:, j) = s*former + c*b(:, j)
      end associate
      vector = v(:, i)
      v(:, i) = real(c, wp)*vector - real(s, wp)*v(:, j)
      v(:, j) = real(s, wp)*vector + real(c, wp)*v(:, j)
      noise = columns%noise(i)
      columns%noise(i) = c*noise + abs(s)*columns%noise(j)
      columns%noise(j) = abs(s)*noise + c*columns%noise(j)
      call measure(columns, i)
      call measure(columns, j)
      columns%flops = columns%flops + 12.0_wp*size(former)
   end subroutine turn

   !> Square root of a number within the range of wp, by Newton's method: the
   !> intrinsic one would need one more library.
   pure real(qp) function root(x)
      real(qp), intent(in) :: x
      integer :: step

      root = sqrt(real(x, wp))
      do step = 1, 2
         if (root > 0) root = (root + x/root)/2
      end do
   end function root

   !> Make columns that nearly are so orthogonal: first those that are improved,
   !> in their order, then the others.
   pure subroutine straighten(left, improved)
      real(wp), intent(inout) :: left(:, :)
      logical, intent(in) :: improved(:)
      logical :: stands(size(left, 2)), first(size(left, 2))
      integer :: j

      stands = .false.
      first = .false.
      first(:size(improved)) = improved
      do j = 1, size(left, 2)
         if (first(j)) call straighten_column(left, j, stands)
      end do
      do j = 1, size(left, 2)
         if (.not. first(j)) call straighten_column(left, j, stands)
      end do
   end subroutine straighten

   !> Make a column orthogonal to those that stand, twice for the sake of rounding.
   pure subroutine straighten_column(left, j, stands)
      real(wp), intent(inout) :: left(:, :)
      integer, intent(in) :: j
      logical, intent(inout) :: stands(:)
      real(wp), parameter :: rounding = 4*epsilon(1.0_wp)
      real(wp) :: cosine, length
      integer :: i, pass

      do pass = 1, 2
         do i = 1, size(left, 2)
            if (.not. stands(i)) cycle
            cosine = dot_product(left(:, i), left(:, j))
            if (abs(cosine) > rounding) left(:, j) = left(:, j) - cosine*left(:, i)
         end do
         length = norm2(left(:, j))
         if (abs(length - 1) > rounding) left(:, j) = left(:, j)/length
      end do
      stands(j) = .true.
   end subroutine straighten_column

   !> Values descend; the vectors go with them.
   pure subroutine sort(values, right, left)
      real(wp), intent(inout) :: values(:), right(:, :)
      real(wp), intent(inout), optional :: left(:, :)
      integer :: j, largest

      do j = 1, size(values) - 1
         largest = j - 1 + maxloc(values(j:), 1)
         if (.not. values(largest) > values(j)) cycle
         values([j, largest]) = values([largest, j])
         right(:, [j, largest]) = right(:, [largest, j])
         if (present(left)) left(:, [j, largest]) = left(:, [largest, j])
      end do
   end subroutine sort
end module flexact_refinement
